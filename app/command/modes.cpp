// `twinarm modes`: modes of the linearised system of a robot or a scene.
#include <fmt/format.h>

#include "app/command/command.h"
#include "app/modes/linear_system.h"
#include "app/robot/robot_input.h"
#include "app/support/files.h"

namespace twinarm {
namespace {

struct ModesOptions {
  RobotOptions robot;
  bool json = false;
};

void add_options(const OptionAdder& add, ModesOptions& options) {
  add.robot(options.robot, "robot (URDF) or scene (TOML)");
  add.group("Output");
  add.json(options.json);
}

int run_modes(const ModesOptions& options) {
  SimulateOptions simulate;
  simulate.robot = options.robot;
  simulate.duration = 1;
  simulate.integrator = "semi-implicit";
  SimulatePlan prepared = prepare_simulation(simulate);
  SimulateInput& input = prepared.input;
  if (input.scene && input.robot.coordinates.all().empty() && input.scene->constraints.empty() &&
      input.scene->springs.empty())
    throw InputError(
        {{input.scene->description.file.string(), 0, "scene",
          "it has neither a robot with a joint nor a constraint or spring, and so no modes",
          "add a [[robot]] with a joint, a [[constraint]] or a [[spring]]", "scene.nothing-held"}});
  check_dense(input.robot.model, options.robot.model);
  const ModesOf found = find_modes(input);
  print_warnings(found.warnings, options.json);
  fmt::print("{}\n", options.json ? modes_json(input, found) : modes_table(input, found));
  return 0;
}

}  // namespace

Command modes_command() {
  return {40, "modes",
          "Compute natural frequencies, damping ratios and mode shapes of the system linearised "
          "about a state\n\n"
          "Examples:\n"
          "  twinarm modes assets/robots/puma560/puma560.urdf\n"
          "  twinarm modes assets/scenes/robot_beside_obstacles.toml",
          add_options, run_modes};
}

}  // namespace twinarm
