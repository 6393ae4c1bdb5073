// Assets, input and output files, standard streams.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "solver/support/atomic_file.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// The assets folder: `given`, or that of the build tree, of the installation, or of the current
// folder. Throws InputError if there is none.
std::filesystem::path find_assets(const std::filesystem::path& given = {});

// A name that begins with assets/ and does not exist is looked up in find_assets(): the examples
// work in any folder. Other names are returned unchanged.
std::filesystem::path find_input(const std::filesystem::path& name);

// Files are written by solver/support/atomic_file.h.

// Throws InputError if the folder cannot be written or created; creates nothing. The message names
// the option.
void require_writable_folder(const std::filesystem::path& folder, const char* option = "--out");
// Creates it with its parents. Throws InputError.
void make_folder(const std::filesystem::path& folder, const char* option = "--out");
// Adds a diagnostic if the file cannot be written, or its folder cannot be made; called before a
// long computation.
void check_place(const std::filesystem::path& file, const char* option, DiagnosticList& faults);
// Whether two names are those of one file, which need not exist.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

// A new folder NAME-XXXXXX for temporary files, removed with them by the destructor, or by the
// signal that ends the program. Throws InputError.
class TemporaryFiles {
 public:
  explicit TemporaryFiles(const std::string& name);
  ~TemporaryFiles();
  const std::filesystem::path& folder() const { return folder_; }
  void make_again() const;  // cleaners of temporary folders may have removed it

 private:
  std::filesystem::path folder_;
  TemporaryPath listed_;
};

// Opens /dev/null for closed standard streams, so that no other file gets their descriptors.
void fill_closed_streams();

// Throws InputError if stdout could not be written completely.
void check_stdout();

// "wrote PATH" for each file that was asked for; nothing if stdout is for programs.
inline void print_wrote(const std::vector<std::filesystem::path>& files, bool for_programs) {
  for (const std::filesystem::path& file : files)
    if (!file.empty() && !for_programs) fmt::print("wrote {}\n", file.string());
}

// Prints a message on stderr; unlike fmt::print it does not throw if that fails.
template <class... Values>
void print_error(fmt::format_string<Values...> words, Values&&... values) {
  std::fputs(fmt::format(words, std::forward<Values>(values)...).c_str(), stderr);
}
// On stderr; not with --json, whose key `warnings` has them.
inline void print_warnings(const std::vector<std::string>& warnings, bool as_json) {
  if (as_json) return;
  for (const std::string& warning : warnings) print_error("twinarm: warning: {}\n", warning);
}

}  // namespace twinarm
