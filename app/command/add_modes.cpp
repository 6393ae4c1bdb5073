// The options of `twinarm modes`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_modes(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<ModesOptions>();
  CLI::App* modes = app.add_subcommand(
      "modes",
      "Frequencies, damping and shapes of small motions about a state, couplings of a scene "
      "included\n\n"
      "Example:  twinarm modes assets/robots/puma560/puma560.urdf");
  add_robot_options(*modes, options->robot, "the robot's URDF, or a scene in TOML");
  modes->add_flag("--json", options->json, "print one JSON object on stdout");
  modes->callback([options, &line] { line.chosen = [options] { return run_modes(*options); }; });
}

}  // namespace twinarm
