// The log of a live run as a file that grows while the run goes on: what was written stays,
// whatever happens to the program (coupling/device/device_log.h).
#pragma once

#include <filesystem>
#include <fstream>

#include "coupling/device/device_log.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

class LiveLog {
 public:
  // Throws InputError where it cannot be written.
  explicit LiveLog(const std::filesystem::path& file)
      : file_(file.string()), stream_(file, std::ios::binary) {
    if (!stream_)
      throw InputError(
          {{file_, 0, "--out", "the log cannot be written", "give a folder that can"}});
    stream_ << hand_log_header();
  }
  void write(const HandStep& step) { stream_ << hand_log_line(step); }
  void flush() { stream_.flush(); }
  bool is_whole() const { return stream_.good(); }  // all that was to be written is
  // Throws InputError where not all of it could be written.
  void finish() {
    stream_.flush();
    if (!stream_)
      throw InputError({{file_, 0, "--out", "the log could not be written to its end",
                         "make room on the disk"}});
  }

 private:
  std::string file_;
  std::ofstream stream_;
};

}  // namespace twinarm
