// Runs a scene or a robot as `twinarm simulate` does.
#include <pybind11/stl.h>

#include "app/inspect/series/force_series.h"
#include "app/python/arrays.h"
#include "app/python/robots.h"
#include "app/python/signals.h"
#include "app/record/record_run.h"
#include "app/support/text.h"

namespace twinarm::python {
namespace {

using namespace py::literals;

Array by_rows(const std::vector<double>& numbers, std::size_t rows, std::size_t columns) {
  Array array = zeros({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)});
  std::copy(numbers.begin(), numbers.end(), array.mutable_data());
  return array;
}

py::object stopped(const std::optional<PostMortem>& found) {
  if (!found) return py::none();
  py::dict why;
  why["time"] = found->time;
  why["step"] = found->step;
  why["reason"] = found->reason;
  why["body"] = found->body;
  why["joint"] = found->joint;
  why["field"] = found->field;
  return why;
}

// A row for each sample.
struct Samples {
  std::vector<double> t, q, qd, values;
  std::vector<std::vector<double>> targets;  // by coupling

  void add(double now, const State<double>& x, SimulateInput& input, ForceSeries* forces) {
    const auto append = [](const std::vector<double>& row, std::vector<double>& rows) {
      rows.insert(rows.end(), row.begin(), row.end());
    };
    const Model<double>& model = input.robot.model;
    const Kinematics k = kinematics_at(model, x);
    t.push_back(now);
    append(q_with_prescribed(model, x), q);
    append(x.qd, qd);
    append(run_values(input.robot, x, k, forces), values);
    targets.resize(input.couplings ? input.couplings->size() : 0);
    for (std::size_t c = 0; c < targets.size(); ++c)
      append(q_with_prescribed(model, input.couplings->target(c, now).x), targets[c]);
  }
};

// Attributes of a Run (twinarm/_run.py).
py::dict run_attributes(const Samples& samples, const SimulateInput& input,
                        const SimulateResult& result, const std::vector<RunColumn>& columns) {
  const auto robot = std::make_shared<Robot>(input.robot);
  const std::size_t rows = samples.t.size();
  const py::dict units = units_of(columns);
  py::dict targets;
  for (std::size_t c = 0; c < samples.targets.size(); ++c)
    targets[py::str(input.couplings->spec(c).name)] =
        by_rows(samples.targets[c], rows, robot->nq());
  std::vector<std::string> warnings = input.robot.warnings;
  warnings.insert(warnings.end(), result.warnings.begin(), result.warnings.end());
  return py::dict("t"_a = array_of(samples.t), "q"_a = by_rows(samples.q, rows, robot->nq()),
                  "qd"_a = by_rows(samples.qd, rows, robot->model.nv),
                  "values"_a = by_rows(samples.values, rows, units.size()), "units"_a = units,
                  "targets"_a = targets, "tau"_a = py::none(), "model"_a = robot,
                  "steps"_a = result.steps, "end"_a = result.end,
                  "stopped"_a = stopped(result.post_mortem),
                  "energy_balance"_a = work_by_row(result.energy_balance),
                  "momentum"_a = momentum_by_row(result.momentum),
                  "input_work"_a = work_by_row(result.input_work), "contacts"_a = result.contacts,
                  "warnings"_a = warnings);
}

py::dict simulate(const py::object& file, const std::optional<double>& duration,
                  const std::optional<double>& step, const std::string& integrator,
                  const std::optional<double>& every, const py::object& state,
                  const std::string& contact, const std::optional<double>& tolerance, bool friction,
                  bool armature, const py::object& set, const py::object& record,
                  bool with_forces) {
  SimulateOptions options =
      run_options(file, step, integrator, state, contact, friction, armature, set);
  if (!duration && options.robot.model.extension() != ".toml")
    throw py::value_error("simulate(): a robot needs duration=SECONDS");
  options.duration = duration;
  options.tolerance = tolerance;
  options.every = every;
  SimulatePlan prepared = prepare_simulation(options);

  Samples samples;
  RunWatch watch;
  std::optional<ForceSeries> forces;
  if (with_forces) forces.emplace(options);
  ForceSeries* const series = forces ? &*forces : nullptr;
  watch.sample = [&](double t, const State<double>& x) {
    samples.add(t, x, prepared.input, series);
  };
  watch.tick = [](double) { check_signals(); };
  watch.interrupted = is_signalled;
  std::optional<RunRecorder> recorder;
  if (!record.is_none()) {
    recorder.emplace(path_of(record), header_of(options, prepared, {"twinarm.simulate"}), prepared);
  }
  watch.look = [&](SteppedRun& run) {
    if (recorder) recorder->look(run);
    if (forces) forces->keep(run);
  };
  const SimulateResult result = [&] {
    const py::gil_scoped_release other_threads;
    return run_plan(prepared.input, prepared.run, watch);
  }();
  if (recorder)
    recorder->finish(result.post_mortem ? "stopped: " + result.post_mortem->reason : "done");
  return run_attributes(samples, prepared.input, result, run_columns(prepared.input.robot, series));
}

std::string name_of(const std::string& path) {
  return "set['" + path + "']";
}

// VALUE as for `twinarm replay --set PATH=VALUE`.
std::string setting_text(const std::string& path, const py::handle& value) {
  if (py::isinstance<py::str>(value)) return py::cast<std::string>(value);
  if (py::isinstance<py::bool_>(value)) return py::cast<bool>(value) ? "true" : "false";
  const std::string what = name_of(path);
  const Array numbers = numbers_of(value, what);
  check_finite(numbers.data(), static_cast<std::size_t>(numbers.size()), what);
  if (numbers.ndim() > 1 || numbers.size() == 0)
    throw py::value_error(what + " must be a number, a text, a flag or a list of numbers");
  std::string text;
  for (py::ssize_t i = 0; i < numbers.size(); ++i)
    text += (i > 0 ? "," : "") + number_text(numbers.data()[i]);
  return text;
}

// set={"coupling.pull.stiffness": 800} of options with a model.
void change_scene(const py::object& set, SimulateOptions& options) {
  if (set.is_none()) return;
  if (options.robot.model.extension() != ".toml")
    throw py::value_error("set= changes a scene; '" + options.robot.model.string() +
                          "' is not a scene: write one that contains the robot");
  DiagnosticList faults;
  Value scene = read_toml(options.robot.model);
  for (const auto& [path, value] : py::cast<py::dict>(set)) {
    const Change change{py::cast<std::string>(path),
                        setting_text(py::cast<std::string>(path), value)};
    DiagnosticList of_change;  // names the command line option
    apply(change, 0, scene, of_change);
    for (Diagnostic fault : of_change.faults()) {
      fault.where = name_of(change.path);
      faults.add(std::move(fault));
    }
  }
  faults.check();
  options.scene = std::move(scene);
}

}  // namespace

py::dict work_by_row(const std::vector<EnergyRow>& rows) {
  py::dict all;
  for (const EnergyRow& row : rows) all[py::str(row.name)] = row.work;
  return all;
}
py::dict momentum_by_row(const std::vector<MomentumRow>& rows) {
  py::dict all;
  for (const MomentumRow& row : rows) {
    Array six = zeros({6});
    store(row.angular, six.mutable_data(0));
    store(row.linear, six.mutable_data(3));
    all[py::str(row.name)] = six;
  }
  return all;
}

SimulateOptions run_options(const py::object& file, const std::optional<double>& step,
                            const std::string& integrator, const py::object& state,
                            const std::string& contact, bool friction, bool armature,
                            const py::object& set) {
  SimulateOptions options;
  options.robot.model = path_of(file);
  if (!state.is_none()) options.robot.state = path_of(state);
  options.robot.friction = friction;
  options.robot.armature = armature;
  options.step = step;
  options.integrator = integrator;
  options.contact = contact;
  change_scene(set, options);
  return options;
}

void add_scenes(py::module_& m) {
  m.def("_simulate", simulate);
  m.def("_remedy", name_remedy);  // of a misspelt name
}

}  // namespace twinarm::python
