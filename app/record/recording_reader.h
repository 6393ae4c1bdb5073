// Reads the valid part of a recording. The file is scanned once, block by block; frames are read on
// demand, from the keyframe before them or from the last one read.
#pragma once

#include <fstream>

#include "app/record/recording.h"

namespace twinarm {

class Recording {
 public:
  // FILE, or FILE.part if FILE does not exist. Throws InputError if it is not a recording, of a
  // newer format, or without a valid frame; notes() lists other damage.
  explicit Recording(const std::filesystem::path& file);

  std::uint32_t version() const { return version_; }  // of its format
  const RecordingHeader& header() const { return header_; }
  const std::vector<std::string>& rows() const { return names_; }  // of the energy balance
  const std::vector<std::string>& momentum_rows() const { return momentum_names_; }
  const std::vector<std::string>& alarms() const { return alarms_; }
  const std::vector<std::string>& notes() const { return notes_; }
  const std::string& end() const { return end_; }  // how the run ended; empty: unknown

  std::size_t size() const { return places_.size(); }
  RecordedFrame frame(std::size_t n) const;
  // The last frame at or before n that has memory.
  std::size_t keyframe(std::size_t n) const { return version_ < 4 ? n : keyframe_of(n).frame; }
  // The last frame at or before t (up to a millionth of a step after it). Throws InputError that
  // names `option` if t is outside the recording.
  std::size_t at(double t, const std::string& option) const;

 private:
  struct Place {
    std::size_t begin, size;  // of the payload
    double t;
  };
  struct Keyframe {
    std::size_t frame, begin, size;  // of the payload that has its memory
  };
  void read_blocks();
  void take(char kind, std::size_t begin, std::string_view payload);
  void take_text(std::string_view text, std::vector<std::string>& texts);
  void take_frame(std::size_t begin, std::string_view payload);
  std::string bytes_at(std::size_t begin, std::size_t size) const;
  const Keyframe& keyframe_of(std::size_t n) const;
  RecordedFrame read_frame(std::size_t n) const;

  std::string file_, end_;
  mutable std::ifstream stream_;
  std::size_t size_ = 0;  // of the file
  std::size_t text_ = 0;  // bytes of names and alarms
  std::uint32_t version_ = 0;
  RecordingHeader header_;
  std::size_t files_ = 0;  // of the header, read so far
  bool has_header_ = false;
  std::vector<std::string> names_, momentum_names_, alarms_, notes_;
  std::vector<Place> places_;
  std::vector<Keyframe> keyframes_;
  mutable FrameCoder coder_;
  mutable std::size_t decoded_ = 0;  // number of the next frame that coder_ decodes
  mutable std::string last_;         // the frame before it, decoded
};

}  // namespace twinarm
