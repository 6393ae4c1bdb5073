#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/commands.h"
#include "app/inspect/command/inspect_input.h"
#include "app/inspect/command/inspect_output.h"
#include "app/nearest_name.h"
#include "app/record/instant.h"

namespace twinarm {
namespace {

constexpr int kFellShort = 1;

void read_passes(const InspectOptions& options, InspectView& view, FaultList& faults) {
  static const std::vector<std::string> names{"1", "2", "3"};
  if (!options.passes.empty()) view.passes.clear();
  for (const std::string& pass : options.passes) {
    const auto found = std::find(names.begin(), names.end(), pass);
    if (found == names.end())
      faults.add({"", 0, "--pass", "there is no pass '" + pass + "'",
                  "give 1 (velocities), 2 (inertias and forces) or 3 (accelerations)"});
    else
      view.passes.push_back(static_cast<int>(found - names.begin()) + 1);
  }
  std::sort(view.passes.begin(), view.passes.end());
  view.passes.erase(std::unique(view.passes.begin(), view.passes.end()), view.passes.end());
  if (options.axes == "link")
    view.axes = BalanceAxes::link;
  else if (options.axes != "world")
    faults.add({"", 0, "--axes", "there are no axes '" + options.axes + "'", "give world or link"});
}

void read_bodies(const InspectOptions& options, const Model<double>& model, InspectView& view,
                 FaultList& faults) {
  const std::vector<std::string> names(model.body_name.begin() + 1, model.body_name.end());
  std::vector<char> wanted(model.parent.size(), options.bodies.empty());
  for (const std::string& body : options.bodies) {
    const auto found = std::find(names.begin(), names.end(), body);
    if (found == names.end())
      faults.add(
          {"", 0, "--body", "there is no body '" + body + "'", name_remedy(body, names, "bodies")});
    else
      wanted[static_cast<std::size_t>(found - names.begin()) + 1] = 1;
  }
  for (std::size_t i = 1; i < wanted.size(); ++i)
    if (wanted[i]) view.bodies.push_back(i);
}

// Of a scene: what is inspected is what the step did.
Check step_check(const Inspection& in, const std::vector<double>& qdd_of_step) {
  constexpr double kTolerance = 1e-9;  // of what the impulse solver leaves
  Check check{"step", "the step's own accelerations, forces by name", 0, kTolerance, ""};
  const Vector3 g = to_eigen(in.model.gravity);
  double size = std::max(g.norm(), 1e-300);
  for (const double qdd : qdd_of_step) size = std::max(size, std::abs(qdd));
  for (std::size_t i = 1; i < in.body_count(); ++i)
    for (std::size_t dof = in.model.iv[i]; dof < in.model.iv[i] + in.model.dofs(i); ++dof) {
      const double error = std::abs(in.w.qdd[dof] - qdd_of_step[dof]) / size;
      if (!(error <= check.error)) {
        check.error = std::isfinite(error) ? error : 1e300;
        check.worst = in.model.body_name[i];
      }
    }
  return check;
}

std::string title_of(const RobotInput& input, const Inspection& in, const InspectOptions& options) {
  const Vec3<double>& g = in.model.gravity;
  return fmt::format(
      "{}: {} bodies that move, {} degrees of freedom; gravity ({:g}, {:g}, {:g}) m/s^2\n{}",
      input.robot.name, in.body_count() - 1, in.model.nv, g.x, g.y, g.z,
      options.robot.state.empty() ? "at its start, no state file"
                                  : "state " + options.robot.state.string());
}

}  // namespace

int run_inspect(const InspectOptions& options) {
  FaultList faults;
  InspectView view;
  read_passes(options, view, faults);
  SimulateOptions simulate;
  simulate.robot = options.robot;
  simulate.duration = 1;
  simulate.step = options.step;
  simulate.integrator = "semi-implicit";
  std::optional<Memory> memory;
  const bool is_recorded = is_recording(options.robot.model);
  if (options.at && !is_recorded)
    faults.add({"", 0, "--at", "is for a recording", "give one, or --state"});
  if (options.step && is_recorded)
    faults.add({"", 0, "--step", "a recording has its own step", "leave it out"});
  double t = 0;
  auto prepared = attempt(faults, [&] {
    if (!is_recorded) return prepare_simulation(simulate);
    RecordedInstant instant = open_instant(options.robot.model, options.at);
    memory = std::move(instant.memory);
    t = instant.t;
    return std::move(instant.prepared);
  });
  if (prepared) read_bodies(options, prepared->input.robot.model, view, faults);
  faults.check();

  SimulateInput& input = prepared->input;
  const bool is_scene = input.scene != nullptr;
  Inspected inspected = is_scene
                            ? inspect_scene(input, prepared->run.step, memory ? &*memory : nullptr)
                            : inspect_robot(input.robot);
  if (is_scene && input.scene->description.integrator.value_or(Integrator::semi_implicit) !=
                      Integrator::semi_implicit)
    inspected.warnings.emplace_back(
        "the forces are those of a semi-implicit step, not of the scene's integrator");
  const Inspection in(input.robot.model, inspected.x, inspected.actors);
  std::vector<Check> checks = run_checks(in);
  if (is_scene) checks.push_back(step_check(in, inspected.qdd_of_step));

  view.warnings = inspected.warnings;
  view.title = title_of(input.robot, in, options);
  if (is_recorded) view.title += fmt::format("; recorded, t = {} s", t);
  fmt::print("{}\n",
             options.json ? inspect_json(in, view, checks) : inspect_text(in, view, checks));
  const bool all_pass =
      std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.pass(); });
  return all_pass ? 0 : kFellShort;
}

}  // namespace twinarm
