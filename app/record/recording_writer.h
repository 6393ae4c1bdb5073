// Writes a recording during a run: into FILE.part, renamed to FILE at the end. Data are flushed
// every 0.25 s at the latest, and readers accept a .part: a crash loses no more.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>

#include "app/record/recording.h"
#include "solver/support/atomic_file.h"

namespace twinarm {

class RecordingWriter {
 public:
  // Throws InputError if the file cannot be written.
  RecordingWriter(const std::filesystem::path& file, RecordingHeader header);
  // Index of a row of the energy or momentum balance (`kind`: kName or kMomentumName of
  // recording_format); writes new names.
  std::uint32_t number_of(char kind, const std::string& row);
  void alarm(const std::string& words);
  void write(RecordedFrame& frame);
  // Writes how the run ended and renames the file. Throws InputError.
  void finish(const std::string& how);

 private:
  void block(char kind, const std::string& payload);
  void flush();

  UnfinishedFile out_;
  std::string waiting_;
  std::chrono::steady_clock::time_point flushed_;
  std::map<char, std::map<std::string, std::uint32_t>> names_;  // by kind
};

std::filesystem::path part_of(const std::filesystem::path& file);

}  // namespace twinarm
