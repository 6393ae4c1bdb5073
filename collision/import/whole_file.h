// Writes a file in one piece: under a temporary name in the same folder, then renamed.
#pragma once

#include <filesystem>
#include <string>

namespace twinarm {

// Throws InputError where the folder does not exist or cannot be written.
void write_whole_file(const std::filesystem::path& file, const std::string& bytes);

}  // namespace twinarm
