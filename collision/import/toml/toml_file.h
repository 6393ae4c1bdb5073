// Text of a TOML file, bounded for toml++.
#pragma once

#include <filesystem>
#include <string>

namespace twinarm {

// Throws InputError if the file does not exist, is larger than 4 MiB, or is nested more than 200
// deep (toml++ recurses on brackets and dotted keys, and limits only brackets).
std::string read_toml_text(const std::filesystem::path& file);

}  // namespace twinarm
