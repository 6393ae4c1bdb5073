// simulate(): runs a scene or a robot as `twinarm simulate` does.
#include <pybind11/stl.h>

#include <map>
#include <memory>
#include <optional>

#include "app/python/arrays.h"
#include "app/python/robots.h"
#include "app/run/run.h"
#include "solver/dynamics/energy_momentum.h"

namespace twinarm::python {
namespace {

// One run; one row per sample.
struct Run {
  std::shared_ptr<Robot> robot;
  std::vector<double> t, q, qd, kinetic, potential;
  std::map<std::string, std::vector<double>> targets;  // by coupling
  SimulateResult result;
};

Array by_rows(const std::vector<double>& numbers, std::size_t rows, std::size_t columns) {
  Array array = zeros({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)});
  std::copy(numbers.begin(), numbers.end(), array.mutable_data());
  return array;
}

void check_signals(double) {
  if (PyErr_Occurred() || PyErr_CheckSignals() != 0) throw py::error_already_set();
}
bool is_signalled() {
  return PyErr_CheckSignals() != 0;  // the next tick throws the exception
}

Run simulate(const py::object& file, const std::optional<double>& duration,
             const std::optional<double>& step, const std::string& integrator,
             const std::optional<double>& every, const py::object& state,
             const std::string& contact, const std::optional<double>& tolerance, bool friction,
             bool armature, const py::object& set) {
  SimulateOptions options;
  options.robot.model = path_of(file);
  if (!duration && options.robot.model.extension() != ".toml")
    throw py::value_error("simulate(): a robot needs duration=SECONDS");
  if (!state.is_none()) options.robot.state = path_of(state);
  options.robot.friction = friction;
  options.robot.armature = armature;
  options.duration = duration;
  options.step = step;
  options.integrator = integrator;
  options.contact = contact;
  options.tolerance = tolerance;
  options.every = every;
  change_scene(set, options);
  SimulatePlan prepared = prepare_simulation(options);
  const Model<double>& model = prepared.input.robot.model;

  Run run;
  RunWatch watch;
  watch.sample = [&](double t, const State<double>& x) {
    run.t.push_back(t);
    const std::vector<double> q = q_with_prescribed(model, x);
    run.q.insert(run.q.end(), q.begin(), q.end());
    run.qd.insert(run.qd.end(), x.qd.begin(), x.qd.end());
    run.kinetic.push_back(kinetic_energy(model, x));
    run.potential.push_back(potential_energy(model, x));
    SceneCouplings* couplings = prepared.input.couplings.get();
    for (std::size_t c = 0; couplings && c < couplings->size(); ++c) {
      const std::vector<double> q_K = q_with_prescribed(model, couplings->target(c, t).x);
      std::vector<double>& rows = run.targets[couplings->spec(c).name];
      rows.insert(rows.end(), q_K.begin(), q_K.end());
    }
  };
  watch.tick = check_signals;
  watch.interrupted = is_signalled;
  run.result = run_plan(prepared.input, prepared.run, watch);
  run.robot = std::make_shared<Robot>(prepared.input.robot);
  return run;
}

py::dict energy_balance_of(const std::vector<EnergyRow>& rows) {
  py::dict all;
  for (const EnergyRow& row : rows) all[py::str(row.name)] = row.work;
  return all;
}
py::dict momentum_energy_balance_of(const std::vector<MomentumRow>& rows) {
  py::dict all;
  for (const MomentumRow& row : rows) {
    Array six = zeros({6});
    store(row.angular, six.mutable_data(0));
    store(row.linear, six.mutable_data(3));
    all[py::str(row.name)] = six;
  }
  return all;
}

py::object stopped(const Run& run) {
  if (!run.result.post_mortem) return py::none();
  const PostMortem& found = *run.result.post_mortem;
  py::dict why;
  why["time"] = found.time;
  why["step"] = found.step;
  why["reason"] = found.reason;
  why["body"] = found.body;
  why["joint"] = found.joint;
  why["field"] = found.field;
  return why;
}

void add_samples(py::class_<Run>& run) {
  const auto array = [&](const char* name, std::vector<double> Run::*numbers, const char* doc) {
    run.def_property_readonly(
        name, [numbers](const Run& r) { return array_of(r.*numbers); }, doc);
  };
  array("t", &Run::t, "(N,) times of the samples [s]");
  run.def_property_readonly(
      "q", [](const Run& r) { return by_rows(r.q, r.t.size(), r.robot->nq()); },
      "(N, nq) coordinates [rad, m]; model.q_of says which is which");
  run.def_property_readonly(
      "qd", [](const Run& r) { return by_rows(r.qd, r.t.size(), r.robot->model.nv); },
      "(N, nv) velocities [rad/s, m/s]; model.qd_of says which is which");
  run.def_property_readonly(
      "targets",
      [](const Run& r) {
        py::dict all;
        for (const auto& [name, q] : r.targets)
          all[py::str(name)] = by_rows(q, r.t.size(), r.robot->nq());
        return all;
      },
      "{coupling: (N, nq)}: coordinates of its target robot, as q [rad, m]; joints of other "
      "robots\n"
      "are at their start");
  array("kinetic_energy", &Run::kinetic, "(N,) [J]");
  array("potential_energy", &Run::potential, "(N,) in the field of gravity [J]");
}

void add_balances(py::class_<Run>& run) {
  run.def_property_readonly(
      "model", [](const Run& r) { return r.robot; }, "all bodies of the scene, as one Model");
  run.def_property_readonly(
      "steps", [](const Run& r) { return r.result.steps; }, "number of steps");
  run.def_property_readonly(
      "end", [](const Run& r) { return r.result.end; },
      "end of the run; if it diverged the last valid time [s]");
  run.def_property_readonly("stopped", stopped,
                            "None, or why it diverged: time [s], step, reason, body, joint, field");
  run.def_property_readonly(
      "energy_balance", [](const Run& r) { return energy_balance_of(r.result.energy_balance); },
      "{row: work [J]}: energy balance; 'numerical' is the residual of the integrator");
  run.def_property_readonly(
      "momentum", [](const Run& r) { return momentum_energy_balance_of(r.result.momentum); },
      "{row: (6,)}: balance of angular momentum (about the world's origin) and linear momentum,\n"
      "world axes [N m s, N s]");
  run.def_property_readonly(
      "input_work", [](const Run& r) { return energy_balance_of(r.result.input_work); },
      "{coupling: work of its target [J]}");
  run.def_property_readonly(
      "contacts", [](const Run& r) { return r.result.contacts; },
      "number of active contact points in the last step");
  run.def_property_readonly(
      "warnings",
      [](const Run& r) {
        std::vector<std::string> all = r.robot->input.warnings;
        all.insert(all.end(), r.result.warnings.begin(), r.result.warnings.end());
        return all;
      },
      "warnings of the files and of the run");
}

}  // namespace

void add_scenes(py::module_& m) {
  py::class_<Run> run(
      m, "Run", "Result of simulate(): N samples in rows, energy and momentum balance of the run.");
  add_samples(run);
  add_balances(run);

  m.def("simulate", simulate, py::arg("file"), py::kw_only(), py::arg("duration") = py::none(),
        py::arg("step") = py::none(), py::arg("integrator") = "", py::arg("every") = py::none(),
        py::arg("state") = py::none(), py::arg("contact") = "", py::arg("tolerance") = py::none(),
        py::arg("friction") = true, py::arg("armature") = true, py::arg("set") = py::none(),
        "Runs a scene (TOML) or a robot (URDF) as `twinarm simulate` does, with bitwise the same\n"
        "results: contacts, couplings, constraints, limits. Defaults are the scene's.\n\n"
        "  duration, step  [s]\n"
        "  integrator      one of integrators()\n"
        "  every           output interval [s]; default: start and end\n"
        "  state           a state file (JSON)\n"
        "  contact         'rigid', 'compliant' or 'event'\n"
        "  tolerance       of dopri5, relative and absolute\n"
        "  set             {path: value}: changes of the scene, as by `twinarm replay\n"
        "                  --set`: {'coupling.pull.stiffness': 800, 'gravity': [0, 0, -1.62]}\n\n"
        "Returns a Run. If the run diverges it ends, with the reason in Run.stopped.");
}

}  // namespace twinarm::python
