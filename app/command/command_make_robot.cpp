#include <fmt/format.h>

#include "app/command/commands.h"
#include "collision/import/recipe/robot_recipe.h"

namespace twinarm {

int run_make_robot(const std::filesystem::path& recipe) {
  make_robot(recipe);
  fmt::print("made {} from {}\n", read_recipe(recipe).robot.name, recipe.string());
  return 0;
}

}  // namespace twinarm
