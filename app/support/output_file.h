// The output folder, and files read whole. Files are written by solver/support/atomic_file.h.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "solver/support/diagnostics.h"

namespace twinarm {

// Whether the folder is there and can be written, or could be made; makes nothing. Throws
// InputError; its remedy names the option.
void require_writable_folder(const std::filesystem::path& folder, const char* option = "--out");
// With all that is above it. Throws likewise.
void make_folder(const std::filesystem::path& folder, const char* option = "--out");
// A fresh one, NAME-XXXXXX where temporary files go; who asks for it removes it. Throws likewise.
std::filesystem::path make_temporary_folder(const std::string& name);
// Adds a fault where a file cannot be written: to be told before the work, and not after it.
void check_place(const std::filesystem::path& file, FaultList& faults);
// Both throw InputError where there is no such file, or it cannot be read.
std::ifstream open_file(const std::filesystem::path& file);
std::string read_whole_file(const std::filesystem::path& file);

}  // namespace twinarm
