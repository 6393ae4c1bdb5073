// Regular files to read: a pipe or a device may never end.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

namespace twinarm {

// All throw InputError if it does not exist, is not a regular file, or cannot be read.
std::ifstream open_file(const std::filesystem::path& file);
std::string read_whole_file(const std::filesystem::path& file);
// Also if it is larger than `max_mib` MiB, then with this fix.
std::string read_bounded_file(const std::filesystem::path& file, std::size_t max_mib,
                              const std::string& fix);

}  // namespace twinarm
