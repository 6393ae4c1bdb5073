#include "app/support/find_files.h"

#include <dlfcn.h>
#include <vector>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

// Of the Python module, whose program is Python's. Of the program itself: what it was called.
std::filesystem::path library_of_this_code() {
  Dl_info found;
  const bool is_known = dladdr(reinterpret_cast<const void*>(&find_assets), &found) != 0;
  return is_known && found.dli_fname ? found.dli_fname : "";
}

}  // namespace

std::filesystem::path find_assets(const std::filesystem::path& given) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<fs::path> places;
  if (!given.empty()) {
    places.push_back(given);
  } else {
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    places.push_back(program.parent_path() / "../../assets");      // build/PRESET/twinarm
    places.push_back(program.parent_path() / "../share/twinarm");  // bin/twinarm, installed
    if (const fs::path library = library_of_this_code(); library.extension() == ".so") {
      places.push_back(library.parent_path() / "../../../assets");  // build/PRESET/python
      places.push_back(library.parent_path() /
                       "../../../share/twinarm");  // lib/python3.11/dist-packages
    }
    places.push_back(fs::current_path(error) / "assets");
  }
  for (const fs::path& place : places)
    if (fs::is_directory(place / "robots", error)) return fs::weakly_canonical(place);
  throw InputError(
      {{places.front().string(), 0, "assets", "the folder with the robots is not there",
        "run from the project's folder, or give --assets", "file.no-assets"}});
}

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
