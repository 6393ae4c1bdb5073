// A file that was typed, and may be one of the program's own.
#pragma once

#include <filesystem>

namespace twinarm {

// What begins with assets/ and is not there lies below find_assets(), so that the examples hold
// wherever the program runs. All else stays as it is.
std::filesystem::path find_input(const std::filesystem::path& name);

}  // namespace twinarm
