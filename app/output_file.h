// Files that are either whole or not there: written to a temporary name, then renamed.
#pragma once

#include <filesystem>
#include <string>

namespace twinarm {

// Throws InputError that names the folder if it cannot be written.
void write_file(const std::filesystem::path& file, const std::string& content);
// Makes the folder, and shows that files can be written in it, before any work is done.
void require_writable_folder(const std::filesystem::path& folder);
std::string read_whole_file(const std::filesystem::path& file);

}  // namespace twinarm
