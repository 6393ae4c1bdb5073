#include "app/map/map_job.h"

#include "app/scene/read/read_scene.h"
#include "coupling/batch/batch_run.h"
#include "coupling/device/device_motion.h"

namespace twinarm {
namespace {

bool varies_couplings(const std::string& path) {
  const std::string last = path.substr(path.rfind('.') + 1);
  return path.starts_with("coupling") && path.find(".target.") == std::string::npos &&
         (last == "stiffness" || last == "damping" || last == "delay" || last == "speed" ||
          last.starts_with("point["));
}

bool is_plain(const SimulatePlan& plan) {
  const SceneModel& scene = *plan.input.scene;
  return plan.run.integrator == Integrator::semi_implicit && !plan.run.locates_events &&
         !scene.may_touch() && !steps_for_flight(scene, plan.run.integrator) &&
         scene.constraints.empty() && scene.springs.empty() && scene.motions.empty() &&
         !scene.couplings.empty() &&
         std::ranges::all_of(scene.couplings, [](const SceneCoupling& c) {
           return c.is_plain_spring() && c.target.kind != CouplingTarget::Kind::synthetic;
         });
}

std::unique_ptr<OperatorMotion> motion_of(const SceneCoupling& coupling) {
  if (coupling.target.kind == CouplingTarget::Kind::trace)
    return read_motion_file(coupling.target.trace);
  return std::make_unique<AutomaticMotion>(
      OperatorMapping{});  // of a target at rest it moves nothing
}

double number_or(const Value& table, const char* key, double otherwise) {
  const Value* value = table.find(key);
  return value ? value->number : otherwise;
}

struct Limits {
  double lower = -HUGE_VAL, upper = HUGE_VAL;
};

struct LaneRunner {
  explicit LaneRunner(const MapJob& of) : job(of), base(prepare_simulation(of.run)) {}

  bool can_run() {
    for (const MapAxis* axis : {&job.x, &job.y})
      if (axis->path != "step" && !varies_couplings(axis->path)) return false;
    if (!is_plain(base)) return false;
    const SceneModel& scene = *base.input.scene;
    joints = measured_joints(scene, job.measured_coupling);
    const SceneCoupling& measured = scene.couplings[job.measured_coupling];
    setup.model = &base.input.robot.model;
    setup.start = base.input.robot.state.x;
    setup.duration = base.run.duration;
    setup.measured = joints.iq;
    add_target(measured);
    for (const SceneCoupling& c : scene.couplings) {
      const bool same = c.target.kind == measured.target.kind &&
                        c.driven.turned == measured.driven.turned &&
                        c.driven.gripper == measured.driven.gripper &&
                        c.target.trace == measured.target.trace && c.rest.q == measured.rest.q;
      if (!same) add_target(c);
      setup.springs.push_back({c.is_linear()                     ? SpringKind::linear
                               : c.measure == SpringSpace::world ? SpringKind::world
                                                                 : SpringKind::joint,
                               c.discretization, c.absolute_damper,
                               same ? 0 : setup.targets.size() - 1, c.spring.body});
    }
    if (!batch_faults(setup).empty() || !find_limits()) return false;
    runs = std::make_unique<BatchRun>(setup);
    return true;
  }

  std::vector<std::optional<CellValues>> run(std::span<const CellPlace> places) {
    std::vector<std::size_t> which;
    std::vector<BatchCell> cells;
    for (std::size_t i = 0; i < places.size(); ++i)
      if (auto cell = cell_at(places[i])) {
        which.push_back(i);
        cells.push_back(std::move(*cell));
      }
    std::vector<BatchResult> results(cells.size());
    runs->run(cells, results);
    std::vector<std::optional<CellValues>> values(places.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
      values[which[i]] = values_of(places[which[i]], cells[i], results[i]);
    return values;
  }

  // The target of the measured coupling is the first.
  void add_target(const SceneCoupling& coupling) {
    hands.push_back(motion_of(coupling));
    setup.targets.push_back({hands.back().get(), coupling.driven, coupling.rest});
  }

  // False if a joint with active limits is not measured.
  bool find_limits() {
    const SceneModel& scene = *base.input.scene;
    limits.assign(joints.names.size(), {});
    if (!limits_act(scene, base.run.integrator)) return true;
    const auto& robots = scene.description.robots;
    for (std::size_t r = 0; r < robots.size(); ++r)
      for (const JointDescription& joint : robots[r].description.joints) {
        if (!joint.is_limited()) continue;
        const std::string name = name_in_scene(scene.description, r, joint.name);
        const auto found = std::ranges::find(joints.names, name);
        if (found == joints.names.end()) return false;
        limits[static_cast<std::size_t>(found - joints.names.begin())] = {joint.lower, joint.upper};
      }
    return true;
  }

  // Nothing if couplings have different speeds or delays.
  std::optional<BatchCell> cell_at(const CellPlace& place) const {
    Value scene = job.scene;
    DiagnosticList faults;
    set_parameters(job, place.x, place.y, scene, faults);
    BatchCell cell;
    cell.h = job.run.step.value_or(number_or(scene, "step", base.run.step));
    const Value* couplings = scene.find("coupling");
    bool has_motion = false;
    for (std::size_t c = 0; c < couplings->items.size(); ++c) {
      const Value& table = couplings->items[c];
      BatchCell::Gains gains{number_or(table, "stiffness", 0), number_or(table, "damping", 0),
                             Vector3::Zero()};
      if (const Value* point = table.find("point"))
        for (std::size_t i = 0; i < 3; ++i)
          gains.p_L[static_cast<Eigen::Index>(i)] = point->items[i].number;
      cell.springs.push_back(gains);
      const CouplingTarget::Kind target = base.input.scene->couplings[c].target.kind;
      if (target != CouplingTarget::Kind::paper && target != CouplingTarget::Kind::trace) continue;
      const double speed = number_or(table, "speed", 1), delay = number_or(table, "delay", 0);
      if (has_motion && (speed != cell.speed || delay != cell.delay)) return std::nullopt;
      cell.speed = speed;
      cell.delay = delay;
      has_motion = true;
    }
    return cell;
  }

  // A of cell_measure.h without the springs [J], for this speed and delay.
  double target_energy(const CellPlace& place, const BatchCell& cell) {
    const auto [found, is_new] = target_energies.try_emplace({cell.speed, cell.delay});
    if (is_new) found->second = reference_energy(prepare_cell(job, place.x, place.y), false);
    return found->second;
  }

  // In the springs at the start [J].
  double spring_energy(const BatchCell& cell) {
    const State<double>& start = base.input.robot.state.x;
    SceneCouplings& couplings = *base.input.couplings;
    const Kinematics k = kinematics_at(base.input.robot.model, start);
    double energy = 0;
    for (std::size_t c = 0; c < couplings.size(); ++c) {
      const SceneCoupling& spec = couplings.spec(c);
      const Vector3& p = cell.springs[c].p_L;
      const Vector3 offset = spec.is_linear()
                                 ? Vector3(couplings.target(c, 0).k.position(spec.spring.body, p) -
                                           k.position(spec.spring.body, p))
                                 : couplings.ends(c, start, k).offset;
      energy += 0.5 * cell.springs[c].k * offset.squaredNorm();
    }
    return energy;
  }

  std::optional<CellValues> values_of(const CellPlace& place, const BatchCell& cell,
                                      const BatchResult& result) {
    if (!result.finished ||
        !is_bounded(result.energy_created, target_energy(place, cell) + spring_energy(cell)))
      return unstable_cell();
    CellValues values{1, 0, 0, result.energy_created, result.input_work_min};
    for (std::size_t j = 0; j < joints.iq.size(); ++j) {
      const double error = result.max_error[j];
      if (!(result.target_lower[j] - error > limits[j].lower))
        return std::nullopt;  // may reach a limit
      if (!(result.target_upper[j] + error < limits[j].upper)) return std::nullopt;
      values[1] = std::max(values[1], result.max_error[j]);
      values[2] = std::max(values[2], result.mean_error[j]);
    }
    if (joints.iq.empty()) values[1] = values[2] = unstable_cell()[1];
    return values;
  }

  const MapJob& job;
  SimulatePlan base;
  MeasuredJoints joints;
  std::vector<Limits> limits;  // by measured joint
  std::vector<std::unique_ptr<OperatorMotion>> hands;
  BatchSetup setup;
  std::unique_ptr<BatchRun> runs;
  std::map<std::pair<double, double>, double> target_energies;  // by speed and delay
};

}  // namespace

CellBatch cell_batch(const MapJob& job) {
  auto runner = std::make_shared<LaneRunner>(job);
  if (!runner->can_run()) return {};
  return [runner](std::span<const CellPlace> places) { return runner->run(places); };
}

}  // namespace twinarm
