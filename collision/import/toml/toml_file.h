// The text of a TOML file that toml++ may be given.
#pragma once

#include <filesystem>
#include <string>

namespace twinarm {

// Throws InputError where there is no such file, it has more than 4 MiB, or is nested more than 200
// deep: toml++ follows brackets and dotted keys by recursion, and counts the brackets alone.
std::string read_toml_text(const std::filesystem::path& file);

}  // namespace twinarm
