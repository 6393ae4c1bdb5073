#include <fmt/format.h>

#include "app/command/command.h"
#include "collision/import/recipe/robot_recipe.h"

namespace twinarm {
namespace {

struct MakeRobotOptions {
  std::filesystem::path recipe;
};

void add_options(const OptionAdder& add, MakeRobotOptions& options) {
  add.input("recipe", options.recipe, "recipe of the robot (TOML)")->required();
}

int run_make_robot(const MakeRobotOptions& options) {
  make_robot(options.recipe);
  fmt::print("made {} from {}\n", read_recipe(options.recipe).robot.name, options.recipe.string());
  return 0;
}

}  // namespace

Command make_robot_command() {
  return {150, "make-robot",
          "Make the URDF and collision hulls of a robot from CAD meshes and densities\n\n"
          "Examples:\n"
          "  twinarm make-robot assets/robots/s103/robot.toml",
          add_options, run_make_robot};
}

}  // namespace twinarm
