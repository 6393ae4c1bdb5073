// The options of `twinarm make-robot`.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command/commands.h"
#include "app/command/options.h"
#include "app/command/shared_options.h"

namespace twinarm {

void add_make_robot(CLI::App& app, CommandLine& line) {
  const auto recipe = std::make_shared<std::filesystem::path>();
  CLI::App* make = app.add_subcommand(
      "make-robot",
      "Make a robot's URDF and collision hulls from its CAD meshes and densities\n\n"
      "Example:  twinarm make-robot assets/robots/s103/robot.toml");
  add_file_option(*make, "recipe", *recipe, "the robot's TOML recipe")->required();
  make->callback([recipe, &line] { line.chosen = [recipe] { return run_make_robot(*recipe); }; });
}

}  // namespace twinarm
