// Writes a file in one piece: under a temporary name in the same folder, then renamed. Every file
// of the project is written by it, so that none is ever seen half.
#pragma once

#include <filesystem>
#include <string>

namespace twinarm {

// Throws InputError where the folder does not exist or cannot be written.
void write_whole_file(const std::filesystem::path& file, const std::string& bytes);

}  // namespace twinarm
