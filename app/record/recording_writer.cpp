#include "app/record/recording_writer.h"

#include <utility>

#include "app/support/files.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

constexpr std::size_t kMaxWaiting = 1 << 18;  // bytes
constexpr std::chrono::milliseconds kMaxWait{250};

std::string bytes_of(std::uint32_t number) {
  StateArchive memory;
  memory.visit(number);
  return memory.bytes();
}

std::filesystem::path checked_place(std::filesystem::path file) {
  DiagnosticList faults;
  check_place(file, "--record", faults);
  faults.check();
  make_folder(folder_of(file), "--record");
  return file;
}

}  // namespace

std::filesystem::path part_of(const std::filesystem::path& file) {
  return file.string() + ".part";
}

RecordingWriter::RecordingWriter(std::filesystem::path file, RecordingHeader header)
    : file_(checked_place(std::move(file))),
      part_(part_of(file_)),
      out_(part_, std::ios::binary | std::ios::trunc),
      flushed_(std::chrono::steady_clock::now()) {
  if (!out_) fail();
  waiting_ = std::string(recording_format::kMagic, 8) + bytes_of(recording_format::kVersion);
  block(recording_format::kHeader, header_text(header));
  for (const RecordedFile& read : header.files) block(recording_format::kFile, read.bytes);
  flush();
}

std::uint32_t RecordingWriter::number_of(char kind, const std::string& row) {
  std::map<std::string, std::uint32_t>& names = names_[kind];
  const auto [place, is_new] = names.try_emplace(row, static_cast<std::uint32_t>(names.size()));
  if (is_new) block(kind, row);
  return place->second;
}

void RecordingWriter::alarm(const std::string& words) {
  block(recording_format::kAlarm, words);
}

void RecordingWriter::write(RecordedFrame& frame) {
  StateArchive memory;
  visit(memory, frame);
  block(recording_format::kFrame, memory.bytes());
  if (waiting_.size() > kMaxWaiting || std::chrono::steady_clock::now() - flushed_ > kMaxWait)
    flush();
}

void RecordingWriter::finish(const std::string& how) {
  block(recording_format::kEnd, how);
  flush();
  out_.close();
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error || !out_) fail();
}

void RecordingWriter::block(char kind, const std::string& payload) {
  const std::size_t begin = waiting_.size();
  waiting_ += kind;
  waiting_ += bytes_of(static_cast<std::uint32_t>(payload.size()));
  waiting_ += payload;
  waiting_ += bytes_of(checksum(waiting_.data() + begin, waiting_.size() - begin));
}

void RecordingWriter::flush() {
  out_.write(waiting_.data(), static_cast<std::streamsize>(waiting_.size()));
  out_.flush();
  if (!out_) fail();
  waiting_.clear();
  flushed_ = std::chrono::steady_clock::now();
}

void RecordingWriter::fail() const {
  throw InputError({{file_.string(), 0, "--record", "the recording cannot be written",
                     "choose a writable folder with free space", "file.unwritable"}});
}

}  // namespace twinarm
