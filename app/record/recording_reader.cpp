#include "app/record/recording_reader.h"

#include <fmt/format.h>

#include "app/support/files.h"
#include "solver/support/input_file.h"

namespace twinarm {
namespace {

// Limits beyond what runs write, checked before memory is allocated.
constexpr std::size_t kMaxBlock = 256u << 20, kMaxText = 64u << 20;  // [bytes]
constexpr std::size_t kMaxFrames = 1u << 24;

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  bytes.copy(reinterpret_cast<char*>(&number), sizeof number, at);
  return number;
}

}  // namespace

void take_state_from_memory(RecordedFrame& frame) {
  if (!frame.memory.empty()) simulation_memory(frame.memory).visit(frame.q, frame.qd);
}

Recording::Recording(const std::filesystem::path& file) : file_(file.string()) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored) && std::filesystem::exists(part_of(file), ignored)) {
    file_ = part_of(file).string();
    notes_.push_back("the recording is incomplete (the run was interrupted): read from " + file_);
  } else if (file.extension() != ".part" && std::filesystem::exists(part_of(file), ignored)) {
    notes_.push_back("it is of an earlier run than " + part_of(file).string() +
                     ", which was interrupted or is still running");
  }
  stream_ = open_file(file_);
  std::error_code unknown;
  size_ = std::filesystem::file_size(file_, unknown);
  if (unknown) size_ = 0;
  const auto reject = [&](const std::string& problem, const std::string& fix,
                          std::string_view code) {
    throw InputError({{file_, 0, "", problem, fix, code}});
  };
  using namespace recording_format;
  std::string start(std::min(size_, kStart), '\0');
  stream_.read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start.empty())
    reject("it is empty: the run did not begin, or the disk was full", "record it again",
           "recording.empty");
  if (!std::string(kMagic, 8).starts_with(start.substr(0, 8)))
    reject("not a twinarm recording", "give a file of `twinarm simulate --record FILE`",
           "recording.form");
  if (start.size() < kStart)
    reject("it is truncated within its first bytes", "record it again", "recording.cut-short");
  version_ = number_at(start, 8);
  if (version_ < 2 || version_ > kVersion)
    reject(fmt::format("its format is version {}; this program reads versions 2 to {}", version_,
                       kVersion),
           version_ > kVersion ? "read it with the newer twinarm that wrote it" : "record it again",
           "recording.version");
  try {
    read_blocks();
  } catch (const std::runtime_error& error) {  // valid checksum, invalid contents
    if (!has_header_) reject(error.what(), "record it again", "recording.header");
    notes_.push_back(std::string("reading stopped: ") + error.what());
  }
  if (!has_header_ || files_ != header_.files.size() || places_.empty())
    reject("it has no valid frame: it is truncated or damaged within the first one",
           "record it again", "recording.cut-short");
}

void Recording::read_blocks() {
  using namespace recording_format;
  std::size_t at = kStart;
  std::string what, block;
  while (at < size_) {
    if (!end_.empty()) {
      notes_.push_back(fmt::format("{} bytes after the end block are ignored", size_ - at));
      return;
    }
    const auto read_up_to = [&](std::size_t end) {
      const std::size_t have = block.size();
      block.resize(end);
      return bool(stream_.read(block.data() + have, static_cast<std::streamsize>(end - have)));
    };
    block.clear();
    const bool has_head = size_ - at >= kBefore + kAfter && read_up_to(kBefore);
    const std::size_t size = has_head ? number_at(block, 1) : 0;
    if (!has_head || size > size_ - at - kBefore - kAfter) {
      what = "is truncated";
      break;
    }
    if (size > kMaxBlock) {
      what = "has a block of more than 256 MiB";
      break;
    }
    if (!read_up_to(kBefore + size + kAfter) ||
        checksum(block.data(), kBefore + size) != number_at(block, kBefore + size)) {
      what = "is damaged (checksum mismatch)";
      break;
    }
    take(block[0], at + kBefore, std::string_view(block).substr(kBefore, size));
    at += kBefore + size + kAfter;
  }
  if (what.empty() && end_.empty()) what = "ends without an end block";
  if (what.empty() || places_.empty()) return;
  notes_.push_back(fmt::format("the file {} at byte {} of {}; read: {} frames, up to t = {} s",
                               what, at, size_, places_.size(),
                               short_number_text(places_.back().t)));
}

void Recording::take(char kind, std::size_t begin, std::string_view payload) {
  using namespace recording_format;
  if (kind == kHeader) {
    if (has_header_) throw std::runtime_error("there is a second header");
    if (version_ == 2) {
      StateArchive memory{std::string(payload)};
      visit_version_2(memory, header_);
      files_ = header_.files.size();
    } else {
      header_ = parse_header(payload, version_);
    }
    has_header_ = true;
  } else if (kind == kFile) {
    if (files_ == header_.files.size()) throw std::runtime_error("there is a file without a path");
    header_.files[files_++].bytes = payload;
  } else if (kind == kName) {
    take_text(payload, names_);
  } else if (kind == kMomentumName) {
    take_text(payload, momentum_names_);
  } else if (kind == kAlarm) {
    take_text(payload, alarms_);
  } else if (kind == kEnd) {
    end_ = payload;
  } else if (kind == kFrame) {
    take_frame(begin, payload);
  } else if (kind == kMemory && version_ > 3) {
    if (!keyframes_.empty() && keyframes_.back().frame == places_.size()) keyframes_.pop_back();
    keyframes_.push_back({places_.size(), begin, payload.size()});
  }
}

void Recording::take_text(std::string_view text, std::vector<std::string>& texts) {
  text_ += text.size() + sizeof(std::string);
  if (text_ > kMaxText) throw std::runtime_error("there are more than 64 MiB of names");
  texts.emplace_back(text);
}

void Recording::take_frame(std::size_t begin, std::string_view payload) {
  StateArchive memory{std::string(payload.substr(0, recording_format::kFrameStart))};
  long step = 0;
  double t = 0;
  memory.visit(step, t);
  if (places_.size() == kMaxFrames)
    throw std::runtime_error("there are more than 16 million frames");
  if (!(t >= (places_.empty() ? -HUGE_VAL : places_.back().t)))
    throw std::runtime_error("the time of a frame is before that of the previous one");
  const std::size_t since =
      keyframes_.empty() ? kMaxFrames : places_.size() - keyframes_.back().frame;
  if (version_ > 3 && since >= recording_format::kKeyframeEvery)
    throw std::runtime_error("64 frames or the first one are without a keyframe");
  places_.push_back({begin, payload.size(), t});
}

std::string Recording::bytes_at(std::size_t begin, std::size_t size) const {
  std::string bytes(size, '\0');
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(begin));
  if (!stream_.read(bytes.data(), static_cast<std::streamsize>(size)))
    throw std::runtime_error("the file has become shorter");
  return bytes;
}

const Recording::Keyframe& Recording::keyframe_of(std::size_t n) const {
  return std::ranges::upper_bound(keyframes_, n, {}, &Keyframe::frame)[-1];
}

RecordedFrame Recording::read_frame(std::size_t n) const {
  using recording_format::kFrameStart;
  RecordedFrame frame;
  if (version_ < 4) {
    StateArchive archive(bytes_at(places_[n].begin, places_[n].size));
    visit_version_3(archive, frame);
    if (!archive.at_end()) throw std::runtime_error("bytes are left over");
    take_state_from_memory(frame);
    return frame;
  }
  const Keyframe& keyframe = keyframe_of(n);
  if (decoded_ <= keyframe.frame || decoded_ > n + 1) {
    decoded_ = keyframe.frame;
    coder_.restart();
  }
  while (decoded_ <= n) {
    const Place& place = places_[decoded_];
    const std::string bytes = bytes_at(place.begin, place.size);
    last_ = bytes.substr(0, kFrameStart) +
            coder_.decode(std::string_view(bytes).substr(kFrameStart), kMaxBlock);
    ++decoded_;
  }
  StateArchive archive(last_);
  visit(archive, frame);
  if (!archive.at_end()) throw std::runtime_error("bytes are left over");
  if (keyframe.frame == n)
    frame.memory = decompressed(bytes_at(keyframe.begin, keyframe.size), kMaxBlock);
  return frame;
}

RecordedFrame Recording::frame(std::size_t n) const {
  RecordedFrame frame;
  bool fits = true;
  try {
    frame = read_frame(n);
  } catch (const std::runtime_error&) {
    decoded_ = 0;
    fits = false;
  }
  const auto all_below = [](const std::vector<std::uint32_t>& numbers, std::size_t count) {
    return std::ranges::all_of(numbers, [&](std::uint32_t i) { return i < count; });
  };
  if (version_ == 2 &&
      frame.coupling_forces.size() < header_.couplings.size())  // the lab changed a coupling
    frame.coupling_forces.resize(header_.couplings.size(), Vector3::Zero());
  fits = fits && frame.values.size() == header_.columns.size() &&
         frame.coupling_forces.size() == header_.couplings.size() &&
         frame.works.size() == frame.rows.size() && all_below(frame.rows, names_.size()) &&
         frame.momenta.size() == 2 * frame.momentum_rows.size() &&
         all_below(frame.momentum_rows, momentum_names_.size());
  if (!fits)
    throw InputError({{file_, 0, fmt::format("frame {}, at byte {}", n, places_[n].begin),
                       "it does not match the header", "record it again", "recording.numbers"}});
  return frame;
}

std::size_t Recording::at(double t, const std::string& option) const {
  const double slack = 1e-6 * std::min(header_.step, 1e-3);  // sums of steps are rounded
  const double first = places_.front().t, last = places_.back().t;
  if (!(t >= first - slack && t <= last + slack))
    throw InputError({{file_, 0, option,
                       short_number_text(t) + " s is outside the recording, from " +
                           short_number_text(first) + " to " + short_number_text(last) + " s",
                       "give a time in this range", "recording.time"}});
  const auto after = std::upper_bound(places_.begin() + 1, places_.end(), t + slack,
                                      [](double end, const Place& place) { return end < place.t; });
  return static_cast<std::size_t>(after - places_.begin()) - 1;
}

}  // namespace twinarm
