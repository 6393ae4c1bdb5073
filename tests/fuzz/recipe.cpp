// The recipe of a robot drawn in CAD.
#include "collision/import/recipe/recipe_file.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {

void recipe(Bytes bytes) {
  goes_through([&] {
    std::vector<Diagnostic> faults;
    read_recipe_file(folder().write("recipe.toml", bytes), faults);
    if (!faults.empty()) throw InputError(faults);
  });
}

}  // namespace twinarm::fuzz
