// What targets share: bytes as a file, and what a reader may throw.
#pragma once

#include <stdlib.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "solver/support/diagnostics.h"
#include "tests/fuzz/targets.h"

namespace twinarm::fuzz {

// Of this process; it goes when the process does.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "twinarm_fuzz_XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder: set TMPDIR");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path write(const std::string& name, Bytes bytes) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<long>(bytes.size()));
    return file;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};
inline const Folder& folder() {
  static const Folder made;
  return made;
}

[[noreturn]] inline void fail(const char* what) {
  std::fprintf(stderr, "fuzz: %s\n", what);
  std::abort();
}
inline void require(bool holds, const char* what) {
  if (!holds) fail(what);
}

// Whether f goes through. It may throw an InputError that tells something, at a length that can be
// read; any other exception leaves, and ends the process.
template <class F>
bool goes_through(F f) {
  try {
    f();
    return true;
  } catch (const InputError& error) {
    constexpr std::size_t kLongest = 1 << 20;
    std::size_t length = 0;
    require(!error.faults().empty(), "an InputError without a fault");
    for (const Diagnostic& fault : error.faults()) {
      require(!fault.problem.empty(), "a fault without a rule");
      length += to_string(fault).size();
    }
    require(length < kLongest, "the faults take more than a megabyte to tell");
    return false;
  }
}

}  // namespace twinarm::fuzz
