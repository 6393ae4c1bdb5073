
#include <fmt/format.h>

#include "app/map/map_results.h"
#include "app/record/record_run.h"
#include "app/support/progress.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

constexpr double kMaxCreated = 100, kReversals = 25,
                 kFallHeight = 1e-3;  // cell_measure.h; the last [m]
constexpr int kTargetSamples = 64;

// Largest energy of the target during its motion; 0 at rest [J].
double max_target_energy(const SimulatePlan& plan, std::size_t c) {
  SceneCouplings& couplings = *plan.input.couplings;
  if (!couplings.spec(c).target.is_operator()) return 0;
  const Model<double>& model = plan.input.robot.model;
  const double height = potential_energy(model, couplings.target(c, 0).x);
  double max = 0;
  for (int i = 0; i <= kTargetSamples; ++i) {
    const State<double>& x = couplings.target(c, plan.run.duration * i / kTargetSamples).x;
    max = std::max(max, kinetic_energy(model, x) + std::abs(potential_energy(model, x) - height));
  }
  return max;
}

double created(const std::vector<EnergyRow>& energy_balance) {
  double sum = 0;
  for (const EnergyRow& row : energy_balance)
    if (row.kind == EnergyRowKind::numerical || row.kind == EnergyRowKind::coupling_implicit)
      sum += row.work;
  return sum;
}

// The scene of the cell with the options of the command line.
Value scene_of_cell(const MapJob& job, double x, double y) {
  Value scene = job.scene;
  DiagnosticList faults;
  set_parameters(job, x, y, scene, faults);
  faults.check();
  if (job.run.step) scene.put("step", Value::of(*job.run.step));
  if (job.run.duration) scene.put("duration", Value::of(*job.run.duration));
  if (!job.run.integrator.empty()) scene.put("integrator", Value::of(job.run.integrator));
  name_files_from_root(job.run.robot.model.parent_path(), scene);
  return scene;
}

CellValues record_cell(const MapJob& job, const OpenedCell& cell,
                       const std::filesystem::path& recording) {
  SimulateOptions options;
  options.robot.model = cell.scene;
  options.record = recording;
  const SimulatePlan plan = prepare_simulation(options);
  CellMeasure measure(plan, measured_joints(*plan.input.scene, job.measured_coupling));
  RunWatch watch;
  watch.look = [&](SteppedRun& run) { measure.look(run); };
  watch.tick = [](double) { check_interrupt(); };
  return measure.values(record_plan(options, plan, watch));
}

}  // namespace

MeasuredJoints measured_joints(const SceneModel& scene, std::size_t coupling) {
  MeasuredJoints joints;
  joints.coupling = coupling;
  if (scene.couplings.empty()) return joints;
  const Model<double>& model = scene.model;
  const SceneCoupling& of = scene.couplings[coupling];
  const auto add = [&](std::size_t body) {
    if (model.dofs(body) != 1) return;
    joints.iq.push_back(model.iq[body]);
    joints.names.push_back(model.joint_name[body]);
    (is_translational(model.joint[body]) ? joints.slide : joints.turn) = true;
  };
  for (const std::string& name : of.driven.turned)
    add(static_cast<std::size_t>(model.find_joint(name)));
  for (int body = of.target.is_operator() ? 0 : of.spring.body; body > 0;
       body = model.parent[static_cast<std::size_t>(body)])
    add(static_cast<std::size_t>(body));
  return joints;
}

double reference_energy(const SimulatePlan& plan, bool with_springs) {
  const Model<double>& model = plan.input.robot.model;
  const State<double>& start = plan.input.robot.state.x;
  double sum = kinetic_energy(model, start) + kFallHeight * weight_of(model), target = 0;
  if (!plan.input.couplings) return sum;
  SceneCouplings& couplings = *plan.input.couplings;
  const Kinematics k = kinematics_at(model, start);
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    if (with_springs)
      sum += 0.5 * couplings.spec(c).spring.k * couplings.ends(c, start, k).offset.squaredNorm();
    target = std::max(target, max_target_energy(plan, c));
  }
  return sum + kReversals * target;
}

bool is_bounded(double created, double reference) {
  return created <= kMaxCreated * reference;
}

CellMeasure::CellMeasure(const SimulatePlan& plan, MeasuredJoints joints)
    : plan_(plan), joints_(std::move(joints)) {
  before_.assign(joints_.iq.size(), 0);
  integral_.assign(joints_.iq.size(), 0);
}

void CellMeasure::look(SteppedRun& run) {
  const State<double>& x = run.simulation().state();
  if (joints_.iq.empty()) return;
  const State<double>& target = plan_.input.couplings->target(joints_.coupling, x.t).x;
  for (std::size_t j = 0; j < joints_.iq.size(); ++j) {
    const double e = std::abs(target.q[joints_.iq[j]] - x.q[joints_.iq[j]]);
    max_ = std::max(max_, e);
    integral_[j] += 0.5 * (x.t - t_before_) * (before_[j] + e);
    before_[j] = e;
  }
  t_before_ = x.t;
  double input = 0;
  for (const EnergyRow& row : run.input_work()) input += row.work;
  min_input_work_ = std::min(min_input_work_, input);
}

CellValues CellMeasure::values(const SimulateResult& result) const {
  const double energy = created(result.energy_balance);
  if (result.post_mortem || !is_bounded(energy, reference_energy(plan_))) return unstable_cell();
  double mean = 0;
  for (const double sum : integral_) mean = std::max(mean, sum / plan_.run.duration);
  const double none = std::numeric_limits<double>::quiet_NaN();
  return {1, joints_.iq.empty() ? none : max_, joints_.iq.empty() ? none : mean, energy,
          min_input_work_};
}

std::pair<int, int> parse_cell(const std::string& text, const MapJob& job) {
  const std::size_t comma = text.find(',');
  const auto index = [](const std::string& part, int count) {
    const double i = parse_number(part).value_or(-1);
    return i >= 0 && i < count && i == std::floor(i) ? static_cast<int>(i) : -1;
  };
  if (comma != std::string::npos) {
    const int ix = index(text.substr(0, comma), job.nx());
    const int iy = index(text.substr(comma + 1), job.ny());
    if (ix >= 0 && iy >= 0) return {ix, iy};
  }
  throw InputError("--cell", "'" + text + "' is not a cell of this map",
                   fmt::format("write IX,IY, from 0,0 to {},{}", job.nx() - 1, job.ny() - 1),
                   "map.cell");
}

OpenedCell open_cell(const MapJob& job, int ix, int iy, const std::filesystem::path& recording) {
  OpenedCell cell{job.x.at(ix), job.y.at(iy), {}, recording, ""};
  cell.scene.replace_extension(".toml");
  write_whole_file(cell.scene, fmt::format("# Cell {},{} of a map of {}: {} = {}, {} = {}\n", ix,
                                           iy, job.run.robot.model.filename().string(), job.x.path,
                                           number_text(cell.x), job.y.path, number_text(cell.y)) +
                                   to_toml(scene_of_cell(job, cell.x, cell.y)));
  cell.values = record_cell(job, cell, recording);
  cell.command = "twinarm simulate " + cell.scene.string();
  return cell;
}

}  // namespace twinarm
