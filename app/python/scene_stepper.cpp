// SceneStepper: a scene step by step, with joint forces and targets that are set between steps.
// Python's SceneSimulation (twinarm/_scene_simulation.py) adds names and documentation.
#include <pybind11/stl.h>

#include "app/inspect/report/inspect_output.h"
#include "app/python/arrays.h"
#include "app/python/robots.h"
#include "app/python/signals.h"
#include "app/record/record_run.h"
#include "app/run/stepped_run.h"
#include "coupling/device/device_motion.h"

namespace twinarm::python {
namespace {

// Replaces the scene's own motion of a target robot from `since` on.
struct GivenTarget {
  explicit GivenTarget(DeviceMotion motion) : recent(std::move(motion)) {}
  DeviceMotion recent;      // as many steps as a delayed coupling reads
  DeviceMotion first{1};    // the energy balance reads the target at the start
  double since = HUGE_VAL;  // [s]

  const OperatorMotion* at(double t, double toward) const {
    const double inside = t + 1e-9 * (toward - t);
    return inside < since ? nullptr : inside <= first.duration() ? &first : &recent;
  }
};

struct SavedState : OnlyConstructed {
  std::string memory;  // SteppedRun::memory()
  Eigen::VectorXd tau;
  std::vector<GivenTarget> targets;
  double t = 0;
};

class SceneStepper : public OnlyConstructed {
 public:
  SceneStepper(const SimulateOptions& options, const py::object& record)
      : options_(options), plan_(prepare()) {
    robot = std::make_shared<Robot>(plan_.input.robot);
    watch_.tick = [](double) { check_signals(); };
    watch_.interrupted = is_signalled;
    if (!record.is_none()) {
      RecordingHeader header = header_of(options_, plan_, {"twinarm.SceneSimulation"});
      header.duration = 1;  // as in the options; the frames go on
      recorder_.emplace(path_of(record), std::move(header), plan_, /*every=*/0,
                        /*keyframe_every=*/1);
    }
    watch_.look = [this](SteppedRun& view) {
      if (recorder_) recorder_->look(view);
    };
    begin(nullptr);
    start_ = saved();
  }
  ~SceneStepper() {
    try {
      close();
    } catch (const std::exception& error) {  // the disk is full, the folder gone
      print_error("twinarm: {}\n", error.what());
    }
  }
  void close() {
    if (recorder_) recorder_->finish("done");
    recorder_.reset();
  }

  void step(long count) {
    for (long n = 0; n < count; ++n) {
      if (run->advance()) continue;
      const PostMortem& found = run->result().post_mortem.value();
      const std::string what = "step " + std::to_string(found.step) + ", body '" + found.body +
                               "': " + found.reason +
                               "; use a shorter step or other gains, and reset()";
      PyErr_SetString(PyExc_FloatingPointError, what.c_str());
      throw py::error_already_set();
    }
  }

  SavedState saved() const {
    SavedState all{{}, run->memory(), plan_.input.robot.state.tau, {}, run->time()};
    for (const auto& target : targets_) all.targets.push_back(*target);
    return all;
  }
  // To a saved state of this scene, bit for bit; null: to the start, with these coordinates and
  // velocities. If that throws the run is at its start.
  void reset(const SavedState* to, const py::object& q, const py::object& qd) {
    const SavedState& from = to ? *to : start_;
    if (from.targets.size() != targets_.size())
      throw py::value_error("reset(): the state is of a scene with other couplings");
    close();  // a recording does not go back in time
    const bool elsewhere = !q.is_none() || !qd.is_none();
    GivenState& state = plan_.input.robot.state;
    try {
      state.x = state_of(*robot, q, qd, 0, robot->input.state.x);
      state.tau = from.tau;
      for (std::size_t c = 0; c < targets_.size(); ++c) *targets_[c] = from.targets[c];
      run.reset();  // refers to the couplings
      connect(plan_);
      begin(elsewhere ? nullptr : &from);
    } catch (...) {
      if (to || elsewhere) reset(nullptr, py::none(), py::none());
      throw;
    }
  }

  const State<double>& x() const { return run->simulation().state(); }
  double h() const { return plan_.run.step; }
  const char* integrator() const { return integrator_name(plan_.run.integrator); }

  // By velocity; zero where no joint of a robot is, and for mimic joints.
  std::vector<double> tau() const {
    std::vector<double> all(robot->model.nv);
    for (const NamedJoint& joint : robot->input.coordinates.all())
      to_solver(joint, x(), plan_.input.robot.state.tau.data() + joint.row, all);
    return all;
  }
  void set_tau(const py::object& given) {
    const std::vector<double> all = vector_of(given, robot->model.nv, "tau", robot->size_of_qd());
    for (const NamedJoint& joint : robot->input.coordinates.all()) {
      const std::vector<double> rows = from_solver(joint, x(), all);
      std::ranges::copy(rows, plan_.input.robot.state.tau.data() + joint.row);
    }
  }

  std::vector<std::string> coupling_names() const { return names_of(plan_.input.scene->couplings); }
  // Empty: its target cannot be set.
  std::vector<std::string> target_joints(std::size_t c) const {
    const SceneCoupling& spec = plan_.input.couplings->spec(c);
    return spec.soft_limits || spec.speed != 1 ? std::vector<std::string>{} : spec.driven.turned;
  }
  void set_target(std::size_t c, const py::object& q, const py::object& qd, bool gripper) {
    const std::size_t count = target_joints(c).size();
    const std::string why = "a number for each of target_joints";
    GivenTarget& target = *targets_[c];
    target.recent.set(
        {vector_of(q, count, "target q", why), vector_of(qd, count, "target qd", why), gripper},
        x().t, h());
    if (target.since >= x().t) {
      target.since = x().t;
      target.first.set(target.recent.newest());
    }
    plan_.input.couplings->forget_operator_motions();
  }
  // Of a coupling: force, error, q and qd of the target robot.
  py::tuple coupling(std::size_t c) {
    SceneCouplings& all = *plan_.input.couplings;
    const Vector3 error = all.ends(c, x(), run->simulation().kinematics()).offset;
    const State<double>& target = all.target(c, x().t).x;
    return py::make_tuple(three(all.force(c)), three(error),
                          array_of(q_with_prescribed(robot->model, target)), array_of(target.qd));
  }
  // Columns of units, as of a Run.
  Array values() const {
    return array_of(run_values(robot->input, x(), run->simulation().kinematics()));
  }
  // Active ones: names of both geometries, depth, point, normal, force and torque on the second.
  py::list contacts() const {
    py::list all;
    const auto& geometries = plan_.input.scene->geometries;
    for (const RecordedContact& c : frame_of(*run, plan_, false).contacts)
      all.append(py::make_tuple(geometries[static_cast<std::size_t>(c.a)].name,
                                geometries[static_cast<std::size_t>(c.b)].name, c.depth,
                                three(c.point), three(c.normal), three(c.force), three(c.couple)));
    return all;
  }

  // As `twinarm inspect --json` of a recording of this instant; `check`: with the cross-checks.
  std::string inspection(bool check) {
    if (!inspector_) {
      inspected_.emplace(prepare());
      inspector_.emplace(inspected_->input, h(), std::vector<NamedSource>{}, plan_.run.integrator);
    }
    inspected_->input.robot.state.tau = plan_.input.robot.state.tau;
    inspected_->input.couplings->forget_operator_motions();
    StateArchive memory = simulation_memory(run->memory());
    const Inspected found = inspector_->look(&memory);
    const Inspection in(inspected_->input.robot.model, found.x, found.actors, found.loops);
    InspectView view;
    for (std::size_t i = 1; i < in.body_count(); ++i) view.bodies.push_back(i);
    view.energy_balance = run->energy_balance();
    view.warnings = found.warnings;
    std::vector<Check> checks;
    if (check) checks = run_checks(in);
    if (check) checks.push_back(step_check(in, found.qdd_of_step));
    return inspect_json(in, view, checks);
  }

 private:
  static Array three(const Vector3& v) { return array_of({v.x(), v.y(), v.z()}); }

  // Without end; every joint force and every target can be set.
  SimulatePlan prepare() {
    SimulatePlan plan = prepare_simulation(options_);
    plan.run.duration = HUGE_VAL;
    plan.run.times.clear();
    plan.input.robot.state.has_tau.assign(plan.input.robot.state.has_tau.size(), true);
    plan.input.robot.state.tau_varies = true;
    for (SceneCoupling& coupling : plan.input.scene->couplings)
      if (!coupling.soft_limits && coupling.driven.turned.empty())
        coupling.driven.turned = turned_joints(*plan.input.scene, coupling.robot);
    connect(plan);
    return plan;
  }
  // Builds the couplings, whose target robots move as targets_; made if there are none.
  void connect(SimulatePlan& plan) {
    const SceneModel& scene = *plan.input.scene;
    targets_.resize(scene.couplings.size());
    const MotionReplacement in_place = [&](std::size_t c, std::unique_ptr<OperatorMotion> own) {
      const std::size_t steps = stored_steps(scene.couplings[c].delay, plan.run.step);
      if (!targets_[c]) targets_[c] = std::make_shared<GivenTarget>(DeviceMotion(steps + 3));
      return std::make_unique<OverridableMotion>(
          std::move(own), [given = targets_[c]](double t, double u) { return given->at(t, u); });
    };
    auto made = std::make_unique<SceneCouplings>(scene, plan.run.step, nullptr, in_place);
    for (std::size_t c = 0; c < made->size(); ++c)
      for (std::size_t before = 0; before < c; ++before)  // couplings share target robots
        if (&made->motion(before) == &made->motion(c)) targets_[c] = targets_[before];
    plan.input.couplings = std::move(made);
  }
  void begin(const SavedState* from) {
    const RunStart start{from ? from->memory : ""};
    run = std::make_unique<SteppedRun>(plan_.input, plan_.run, watch_, from ? &start : nullptr);
    if (!from) run->begin();
  }

  SimulateOptions options_;
  std::vector<std::shared_ptr<GivenTarget>> targets_;  // by coupling
  SimulatePlan plan_;
  SavedState start_;
  RunWatch watch_;
  std::optional<RunRecorder> recorder_;
  std::optional<SimulatePlan> inspected_;  // a second one: look() changes its state
  std::optional<SceneInspector> inspector_;

 public:
  std::shared_ptr<Robot> robot;
  std::unique_ptr<SteppedRun> run;
};

}  // namespace

void add_scene_stepper(py::module_& m) {
  py::class_<SavedState, std::shared_ptr<SavedState>>(
      m, "SavedState", "State of a SceneSimulation, for its reset().")
      .def_readonly("t", &SavedState::t, "time [s]");
  py::class_<SceneStepper, std::shared_ptr<SceneStepper>>(m, "_SceneStepper")
      .def(py::init([](const py::object& file, const std::optional<double>& step,
                       const std::string& integrator, const py::object& state,
                       const std::string& contact, bool friction, bool armature,
                       const py::object& set, const py::object& record) {
        SimulateOptions options =
            run_options(file, step, integrator, state, contact, friction, armature, set);
        if (!options.scene) options.scene = read_toml(options.robot.model);
        options.duration = 1;  // not used
        return std::make_shared<SceneStepper>(options, record);
      }))
      .def("_step", &SceneStepper::step)
      .def("_save", [](const SceneStepper& s) { return std::make_shared<SavedState>(s.saved()); })
      .def("_reset", &SceneStepper::reset)
      .def("_close", &SceneStepper::close)
      .def("_couplings", &SceneStepper::coupling_names)
      .def("_target_joints", &SceneStepper::target_joints)
      .def("_set_target", &SceneStepper::set_target)
      .def("_coupling", &SceneStepper::coupling)
      .def("_contacts", &SceneStepper::contacts)
      .def("_inspection", &SceneStepper::inspection)
      .def("_set_tau", &SceneStepper::set_tau)
      .def("_model", [](const SceneStepper& s) { return s.robot; })
      .def("_settings",
           [](const SceneStepper& s) {
             return py::make_tuple(s.h(), s.integrator(), units_of(run_columns(s.robot->input)));
           })
      .def("_now",
           [](const SceneStepper& s) {
             return py::make_tuple(s.run->time(), s.run->step(),
                                   frozen(q_with_prescribed(s.robot->model, s.x())),
                                   frozen(s.x().qd), frozen(s.tau()));
           })
      .def("_values", &SceneStepper::values)
      .def("_warnings", [](const SceneStepper& s) { return s.run->result().warnings; })
      .def("_balances", [](const SceneStepper& s) {
        return py::make_tuple(work_by_row(s.run->energy_balance()),
                              work_by_row(s.run->input_work()), momentum_by_row(s.run->momentum()));
      });
}

}  // namespace twinarm::python
