#include "app/support/find_input.h"

#include "app/support/find_assets.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

std::filesystem::path find_input(const std::filesystem::path& name) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (name.empty() || *name.begin() != "assets" || fs::exists(name, error)) return name;
  try {
    const fs::path found = find_assets() / name.lexically_relative("assets");
    return fs::exists(found, error) ? found : name;
  } catch (const InputError&) {  // no assets: the name is told as it was typed
    return name;
  }
}

}  // namespace twinarm
