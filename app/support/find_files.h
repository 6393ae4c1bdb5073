// Where robots, scenes and settings lie: assets, and what was typed.
#pragma once

#include <filesystem>

namespace twinarm {

// The assets folder: beside the program's build tree, installed with it, or below the current
// folder. Throws InputError where it is not there.
std::filesystem::path find_assets(const std::filesystem::path& given = {});

// A file that was typed, and may be one of the program's own.
// What begins with assets/ and is not there lies below find_assets(), so that the examples hold
// wherever the program runs. All else stays as it is.
std::filesystem::path find_input(const std::filesystem::path& name);

}  // namespace twinarm
