#include <fmt/format.h>

#include "app/command/command.h"
#include "app/inspect/report/inspect_output.h"
#include "app/page/pages.h"
#include "app/record/unpack.h"
#include "app/support/files.h"
#include "solver/support/atomic_file.h"

namespace twinarm {
namespace {

void add_options(const OptionAdder& add, InspectOptions& options) {
  add.robot(options.robot, "robot (URDF), scene (TOML) or recording");
  add("--at", options.at, "time in a recording [s]; default: its end");
  add("--step", options.step, "step of a scene [s]; default: the scene's");
  add.group("Selection");
  add("--pass", options.passes, "passes of ABA: 1, 2 or 3; default: all");
  add("--body", options.bodies, "names of links and bodies; default: all");
  add("--axes", options.axes,
      "axes of the wrenches: world, link (each body's own), or the name of a body");
  add("--about", options.about,
      "reference point of torques: origin or com (each body's own), the name of a body, or a point "
      "x,y,z of the world");
  add("--force", options.forces,
      "show only these forces: coupling/NAME, contact/A-B, constraint/NAME ..");
  add.group("Output");
  add.output("--html", options.html, ".html", "write a page that steps through the passes");
  add.json(options.json);
}

constexpr int kFailed = 1;

std::string title_of(const RobotInput& input, const Inspection& in, const std::string& state) {
  const Vec3<double>& g = in.model.gravity;
  return fmt::format(
      "{}: {} moving bodies, {} degrees of freedom; gravity ({:g}, {:g}, {:g}) m/s^2\n{}",
      input.robot.name, in.body_count() - 1, in.model.nv, g.x, g.y, g.z, state);
}

// Rejects options that do not apply to the model.
void check_useless(const InspectOptions& options, bool is_recorded, DiagnosticList& faults) {
  if (options.at && !is_recorded)
    faults.add("--at", "applies to a recording only", "give one, or --state", "option.useless");
  if (options.step && is_recorded)
    faults.add("--step", "a recording has its own step", "leave it out", "option.useless");
  else if (options.step && options.robot.model.extension() != ".toml")
    faults.add("--step", "applies to a scene only", "leave it out, or give a scene",
               "option.useless");
  if (is_recorded) check_recorded(options.robot, faults);
}

// The model at an instant, and how to show it.
struct Reading {
  InspectView view;
  RecordedInstant instant;  // without a recording only the plan
  Inspected inspected;
};

// Throws InputError with all errors of options and files.
Reading read_all(const InspectOptions& options, bool is_recorded) {
  DiagnosticList faults;
  InspectView view;
  read_passes(options, view, faults);
  check_useless(options, is_recorded, faults);
  SimulateOptions simulate;
  simulate.robot = options.robot;
  simulate.duration = 1;
  simulate.step = options.step;
  simulate.integrator = "semi-implicit";
  auto instant = attempt(faults, [&] {
    return is_recorded ? open_instant(options.robot.model, options.at)
                       : RecordedInstant{prepare_simulation(simulate), {}, 0, {}, {}};
  });
  std::optional<Inspected> inspected;
  if (instant) {
    SimulateInput& input = instant->prepared.input;
    const RunPlan& run = instant->prepared.run;
    read_bodies(options, input.robot.model, view, faults);
    inspected = attempt(faults, [&] {
      if (!input.scene) return inspect_robot(input.robot);
      return is_recorded
                 ? SceneInspector(input, run.step, {}, run.integrator).look(&instant->memory)
                 : SceneInspector(input, run.step).look();
    });
  }
  if (inspected) read_forces(options, inspected->actors, view, faults);
  faults.check();
  view.energy_balance = std::move(instant->energy_balance);
  return {std::move(view), std::move(*instant), std::move(*inspected)};
}

int run_inspect(const InspectOptions& options, const Words& typed) {
  const bool is_recorded = is_recording(options.robot.model);
  auto [view, instant, inspected] = read_all(options, is_recorded);
  const SimulateInput& input = instant.prepared.input;
  check_dense(input.robot.model, options.robot.model);
  const bool is_scene = input.scene != nullptr;
  if (is_scene && input.scene->description.integrator.value_or(Integrator::semi_implicit) !=
                      Integrator::semi_implicit)
    inspected.warnings.emplace_back(
        "forces are those of a semi-implicit step, not of the scene's integrator");
  const Inspection in(input.robot.model, inspected.x, inspected.actors, inspected.loops);
  std::vector<Check> checks = run_checks(in);
  if (is_scene) checks.push_back(step_check(in, inspected.qdd_of_step));

  view.warnings = inspected.warnings;
  warn_of_bad_numbers(in, view.warnings);
  const std::string file = options.robot.state.string();
  view.title = title_of(input.robot, in,
                        is_recorded    ? fmt::format("recorded, t = {:.9g} s", instant.t)
                        : file.empty() ? "at the start, no state file"
                                       : "state " + file);
  if (!options.html.empty()) {
    const InspectedJson words{input.robot.robot.name, view.title, typed};
    write_whole_file(options.html,
                     inspect_page(input, inspected.x, inspect_json(in, view, checks), words));
  }
  print_warnings(view.warnings, options.json);
  fmt::print("{}\n",
             options.json ? inspect_json(in, view, checks) : inspect_text(in, view, checks));
  print_wrote({options.html}, options.json);
  const bool all_pass =
      std::ranges::all_of(checks, [](const Check& check) { return check.pass(); });
  return all_pass ? 0 : kFailed;
}

}  // namespace

Command inspect_command() {
  return {30, "inspect",
          "Show each pass of the articulated-body algorithm (ABA) with its numbers and free-body "
          "diagrams, and check it by CRBA and RNEA\n\n"
          "Examples:\n"
          "  twinarm inspect assets/robots/s103/s103.urdf --body arm2\n"
          "  twinarm inspect out/run.twinrec --at 0.5 --html out/inspect.html",
          add_options, run_inspect};
}

}  // namespace twinarm
