// Whole files of bounded size.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace twinarm {

// Throws InputError if the file is missing, larger than `max_mib` MiB (then with this fix), or
// unreadable.
std::string read_bounded_file(const std::filesystem::path& file, std::size_t max_mib,
                              const std::string& fix);

}  // namespace twinarm
