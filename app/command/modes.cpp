// `twinarm modes`: small motions about a state, of a robot or of a scene whose parts are held.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/command/command.h"
#include "app/command/parser/shared_options.h"
#include "app/modes/modes.h"
#include "app/robot/robot_input.h"

namespace twinarm {
namespace {

struct ModesOptions {
  RobotOptions robot;
  bool json = false;
};

void add_options(CLI::App& command, ModesOptions& options) {
  add_robot_options(command, options.robot, "the robot's URDF, or a scene in TOML");
  add_json_option(command, options.json);
}

int run_modes(const ModesOptions& options) {
  DiagnosticList faults;
  SimulateOptions simulate;
  simulate.robot = options.robot;
  simulate.duration = 1;
  simulate.integrator = "semi-implicit";
  auto prepared = attempt(faults, [&] { return prepare_simulation(simulate); });
  faults.check();

  SimulateInput& input = prepared->input;
  if (input.scene && input.robot.coordinates.all().empty() && input.scene->constraints.empty())
    throw InputError({{input.scene->description.file.string(), 0, "scene",
                       "it has neither a robot with a joint nor a constraint, and modes are those "
                       "of what is held",
                       "", "scene.nothing-held"}});
  const ModesOf found = find_modes(input);
  fmt::print("{}\n", options.json ? modes_json(input, found) : modes_table(input, found));
  return 0;
}

}  // namespace

Command modes_command() {
  return {40, "modes",
          "Frequencies, damping and shapes of small motions about a state, couplings of a scene "
          "included\n\n"
          "Example:  twinarm modes assets/robots/puma560/puma560.urdf",
          add_options, run_modes};
}

}  // namespace twinarm
