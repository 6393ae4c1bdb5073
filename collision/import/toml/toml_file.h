// Text of a TOML file, bounded for toml++.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace twinarm {

// Throws InputError if the file does not exist, is larger than 4 MiB, or is nested deeper (toml++
// recurses on brackets and dotted keys, and limits only brackets).
inline constexpr std::size_t kMaxTomlDepth = 200;
std::string read_toml_text(const std::filesystem::path& file);

}  // namespace twinarm
