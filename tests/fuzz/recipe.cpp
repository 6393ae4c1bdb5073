// The recipe of a robot drawn in CAD.
#include "app/recipe/robot_recipe.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {

void recipe(Bytes bytes) {
  goes_through([&] {
    DiagnosticList faults;
    read_recipe_file(folder().write("recipe.toml", bytes), faults);
    faults.check();
  });
}

}  // namespace twinarm::fuzz
