// Where the robots, scenes and settings lie.
#pragma once

#include <filesystem>

namespace twinarm {

// The assets folder: beside the program's build tree, installed with it, or below the current
// folder. Throws InputError where it is not there.
std::filesystem::path find_assets(const std::filesystem::path& given = {});

}  // namespace twinarm
