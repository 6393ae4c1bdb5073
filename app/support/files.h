// Where robots, scenes and settings lie: assets, and what was typed.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "solver/support/diagnostics.h"

namespace twinarm {

// The assets folder: beside the program's build tree, installed with it, or below the current
// folder. Throws InputError where it is not there.
std::filesystem::path find_assets(const std::filesystem::path& given = {});

// A file that was typed, and may be one of the program's own.
// What begins with assets/ and is not there lies below find_assets(), so that the examples hold
// wherever the program runs. All else stays as it is.
std::filesystem::path find_input(const std::filesystem::path& name);

// The output folder, and files read whole. Files are written by solver/support/atomic_file.h.

// Whether the folder is there and can be written, or could be made; makes nothing. Throws
// InputError; its remedy names the option.
void require_writable_folder(const std::filesystem::path& folder, const char* option = "--out");
// With all that is above it. Throws likewise.
void make_folder(const std::filesystem::path& folder, const char* option = "--out");
// A fresh one, NAME-XXXXXX where temporary files go; who asks for it removes it. Throws likewise.
std::filesystem::path make_temporary_folder(const std::string& name);
// Adds a fault where a file cannot be written: to be told before the work, and not after it.
void check_place(const std::filesystem::path& file, DiagnosticList& faults);
// Both throw InputError where there is no such file, or it cannot be read.
std::ifstream open_file(const std::filesystem::path& file);
std::string read_whole_file(const std::filesystem::path& file);

// Standard streams that may be closed, full, or of a terminal that is gone.

// First of all: takes the place of those that are closed. Else the next file that is opened would
// get the number of, say, stdout, and what is printed would go into it.
void fill_closed_streams();

// Throws InputError where something that was printed on stdout did not get out.
void check_stdout();

// Words for people, on stderr. That nobody is there to read them is no fault: fmt::print would
// throw.
template <class... Values>
void say(fmt::format_string<Values...> words, Values&&... values) {
  std::fputs(fmt::format(words, std::forward<Values>(values)...).c_str(), stderr);
}

}  // namespace twinarm
