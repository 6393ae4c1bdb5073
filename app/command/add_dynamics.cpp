// The options of `twinarm dynamics`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_dynamics(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<DynamicsOptions>();
  CLI::App* dynamics = app.add_subcommand(
      "dynamics",
      "Forward and inverse dynamics, mass matrix, energies of a robot in one state\n\n"
      "Example:  twinarm dynamics assets/robots/puma560/puma560.urdf --state "
      "assets/states/puma_qn.json");
  add_robot_options(*dynamics, options->robot, "the robot's URDF");
  dynamics->add_flag("--json", options->json, "print one JSON object on stdout");
  dynamics->callback(
      [options, &line] { line.chosen = [options] { return run_dynamics(*options); }; });
}

}  // namespace twinarm
