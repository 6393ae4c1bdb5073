// Atomic file write: temporary file in the same folder, then rename. All output files are written
// this way, so that no partial file is visible.
#pragma once

#include <filesystem>
#include <string>

namespace twinarm {

// Throws InputError if the folder does not exist or is not writable.
void write_whole_file(const std::filesystem::path& file, const std::string& bytes);

}  // namespace twinarm
