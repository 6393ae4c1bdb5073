// Atomic file write: temporary file in the same folder, then rename. All output files are written
// this way, so that no partial file is visible.
#pragma once

#include <filesystem>
#include <string>

namespace twinarm {

// Makes the folder if it is missing. Throws InputError if the file cannot be written, or is a
// device.
void write_whole_file(const std::filesystem::path& file, const std::string& bytes);

}  // namespace twinarm
