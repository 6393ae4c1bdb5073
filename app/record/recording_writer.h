// Writes a recording while a run goes on: into FILE.part, which becomes FILE when the run has
// ended. What was handed over to the system (at least every quarter of a second) is there however
// the program ends; readers take a .part too.
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "app/record/recording.h"

namespace twinarm {

class RecordingWriter {
 public:
  // Throws InputError where the file cannot be written.
  RecordingWriter(std::filesystem::path file, RecordingHeader header);
  // Numbers of the ledger's rows by name: a new name is written down first.
  std::uint32_t number_of(const std::string& row);
  std::uint32_t momentum_number_of(const std::string& row);
  void alarm(const std::string& words);
  void write(RecordedFrame& frame);
  // The end of the run in a word, then the file's own name. Throws InputError.
  void finish(const std::string& how);

 private:
  void block(char kind, const std::string& payload);
  void flush();
  [[noreturn]] void fail() const;

  std::filesystem::path file_, part_;
  std::ofstream out_;
  std::string waiting_;
  std::chrono::steady_clock::time_point flushed_;
  using Names = std::map<std::string, std::uint32_t>;
  std::uint32_t number_in(Names& names, char kind, const std::string& row);
  Names names_, momentum_names_;
};

std::filesystem::path part_of(const std::filesystem::path& file);

}  // namespace twinarm
