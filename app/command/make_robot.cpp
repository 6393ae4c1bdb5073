#include "app/command/command.h"
#include "app/recipe/robot_recipe.h"
#include "app/support/files.h"

namespace twinarm {
namespace {

struct MakeRobotOptions {
  std::filesystem::path recipe;
};

void add_options(const OptionAdder& add, MakeRobotOptions& options) {
  add.input("recipe", options.recipe, ".toml", "recipe of the robot (TOML)")->required();
}

int run_make_robot(const MakeRobotOptions& options) {
  const RecipeResult made = make_robot(options.recipe);
  std::vector<std::filesystem::path> files{options.recipe};
  files.front().replace_filename(made.robot.name + ".urdf");
  for (const HullFile& hull : made.hulls) files.push_back(hull.file);
  print_wrote(files, false);
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
