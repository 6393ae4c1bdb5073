#include "app/record/recording.h"

#include "app/support/files.h"

namespace twinarm {
namespace {

constexpr std::size_t kMaxWaiting = 1 << 15;  // bytes
constexpr std::chrono::milliseconds kMaxWait{250};

std::string bytes_of(std::uint32_t number) {
  StateArchive memory;
  memory.visit(number);
  return memory.bytes();
}

const std::filesystem::path& checked_place(const std::filesystem::path& file) {
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

RecordingWriter::RecordingWriter(const std::filesystem::path& file, RecordingHeader header,
                                 long keyframe_every)
    : out_(checked_place(file), part_of(file)),
      flushed_(std::chrono::steady_clock::now()),
      keyframe_every_(keyframe_every) {
  waiting_ = std::string(recording_format::kMagic, 8) + bytes_of(recording_format::kVersion);
  block(recording_format::kHeader, header_text(header));
  for (const RecordedFile& read : header.files) block(recording_format::kFile, read.bytes);
  flush();
}

std::uint32_t RecordingWriter::number_of(char kind, const std::string& row) {
  Names& known = names_[kind];
  // Most rows come in the order of the frame before.
  std::uint32_t number = known.names.empty() ? 0 : known.after[known.last];
  if (known.names.empty() || known.names[number] != row) {
    const auto [place, is_new] =
        known.numbers.try_emplace(row, static_cast<std::uint32_t>(known.names.size()));
    number = place->second;
    if (is_new) {
      known.names.push_back(row);
      known.after.push_back(0);
      block(kind, row);
    }
    known.after[known.last] = number;
  }
  return known.last = number;
}

void RecordingWriter::write(RecordedFrame& frame) {
  if (frame_bytes_ == 0) out_.keep();
  if (needs_memory(frame.step)) {
    keyframe_ = frame.step;
    coder_.restart();
    block(recording_format::kMemory, compressed(frame.memory));
  }
  take_state_from_memory(frame);
  StateArchive archive;
  archive.reserve(frame_bytes_ + frame_bytes_ / 8);
  visit(archive, frame);
  const std::string_view bytes = archive.bytes();
  frame_bytes_ = bytes.size();
  block(recording_format::kFrame, bytes.substr(0, recording_format::kFrameStart),
        coder_.encode(bytes.substr(recording_format::kFrameStart)));
  if (waiting_.size() > kMaxWaiting || std::chrono::steady_clock::now() - flushed_ > kMaxWait)
    flush();
}

void RecordingWriter::finish(const std::string& how) {
  if (frame_bytes_ == 0) return;
  block(recording_format::kEnd, how);
  flush();
  out_.finish();
}

void RecordingWriter::block(char kind, std::string_view start, std::string_view rest) {
  const std::size_t begin = waiting_.size();
  waiting_ += kind;
  waiting_ += bytes_of(static_cast<std::uint32_t>(start.size() + rest.size()));
  waiting_.append(start).append(rest);
  waiting_ += bytes_of(checksum(waiting_.data() + begin, waiting_.size() - begin));
}

void RecordingWriter::flush() {
  out_.write(waiting_);
  waiting_.clear();
  flushed_ = std::chrono::steady_clock::now();
}

}  // namespace twinarm
