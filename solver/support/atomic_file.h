// Output files appear under their names complete or not at all: a temporary file in the same
// folder, then rename. All output files are written this way.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace twinarm {

std::filesystem::path folder_of(const std::filesystem::path& file);  // "." if it names none

// While it exists, remove_temporary_paths() removes this file, or folder with all that is in it.
class TemporaryPath {
 public:
  explicit TemporaryPath(const std::filesystem::path& path);
  ~TemporaryPath();
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

 private:
  std::size_t place_ = 0;
};
// Of this process. Async-signal-safe: for a signal handler that ends the program.
void remove_temporary_paths() noexcept;

// A file on its way: `temporary`, which becomes `file`.
class UnfinishedFile {
 public:
  // Creates `temporary`, which is removed where it is not finished. An unfinished file of before is
  // replaced, and a link that lies there: it is not followed. Throws InputError if it cannot be
  // created, if `file` is a device or a pipe, or if another program is writing `temporary`.
  UnfinishedFile(std::filesystem::path file, std::filesystem::path temporary);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  void write(std::string_view bytes);  // throws InputError
  void keep();                         // from now on `temporary` remains where it is not finished
  // Renames it, when its bytes are on the disk: power may fail from here on. Throws InputError.
  void finish();
  const std::filesystem::path& temporary() const { return temporary_; }

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path file_, temporary_;
  int descriptor_ = -1;
  std::optional<TemporaryPath> listed_;  // while it is to be removed
};

// Makes the folder if it is missing. Throws InputError if the file cannot be written, or is a
// device.
void write_whole_file(const std::filesystem::path& file, const std::string& bytes);

}  // namespace twinarm
