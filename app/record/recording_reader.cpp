#include "app/record/recording_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "app/output_file.h"
#include "app/record/recording_writer.h"
#include "collision/import/number_text.h"
#include "solver/fault.h"

namespace twinarm {
namespace {

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  bytes.copy(reinterpret_cast<char*>(&number), sizeof number, at);
  return number;
}

}  // namespace

Recording::Recording(const std::filesystem::path& file) : file_(file.string()) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored) && std::filesystem::exists(part_of(file), ignored)) {
    file_ = part_of(file).string();
    notes_.push_back("the run that wrote it did not come to its end: read from " + file_);
  } else if (file.extension() != ".part" && std::filesystem::exists(part_of(file), ignored)) {
    notes_.push_back("it is of an earlier run than " + part_of(file).string() +
                     ", which did not come to its end, or still goes on");
  }
  bytes_ = read_whole_file(file_);
  const auto refuse = [&](const std::string& rule, const std::string& remedy) {
    throw InputError({{file_, 0, "", rule, remedy}});
  };
  using namespace recording_format;
  if (bytes_.size() < kStart || bytes_.compare(0, 8, kMagic, 8) != 0)
    refuse(bytes_.empty()
               ? "it is empty: the run that was to write it did not begin, or the disk was full"
           : std::string(kMagic, 8).starts_with(bytes_.substr(0, 8))
               ? "it is cut short within its first bytes"
               : "it is no recording",
           "give a file that `twinarm simulate --record FILE` wrote");
  if (const std::uint32_t version = number_at(bytes_, 8); version != kVersion)
    refuse(
        fmt::format("its format is version {}; this program reads version {}", version, kVersion),
        version > kVersion ? "read it with the newer twinarm that wrote it" : "record it again");
  try {
    read_blocks();
  } catch (const std::runtime_error& error) {  // whole by its checksum, yet not to be understood
    notes_.push_back(std::string("reading stopped: ") + error.what());
  }
  if (!has_header_ || places_.empty())
    refuse("nothing of it is whole: it is cut short or damaged within its first frame",
           "record it again");
}

void Recording::read_blocks() {
  using namespace recording_format;
  std::size_t at = kStart;
  std::string what;
  while (at < bytes_.size()) {
    if (!end_.empty()) {
      notes_.push_back(fmt::format(
          "{} bytes after the mark of its end do not belong to it: left out", bytes_.size() - at));
      return;
    }
    const bool has_head = bytes_.size() - at >= kBefore + kAfter;
    const std::size_t size = has_head ? number_at(bytes_, at + 1) : 0;
    if (!has_head || size > bytes_.size() - at - kBefore - kAfter) {
      what = "is cut short";
      break;
    }
    if (checksum(bytes_.data() + at, kBefore + size) != number_at(bytes_, at + kBefore + size)) {
      what = "is damaged (its checksum differs)";
      break;
    }
    take(bytes_[at], at + kBefore, size);
    at += kBefore + size + kAfter;
  }
  if (what.empty() && end_.empty()) what = "ends without the mark of its end";
  if (what.empty() || places_.empty()) return;
  notes_.push_back(fmt::format("the file {} at byte {} of {}; kept: {} frames, up to t = {} s",
                               what, at, bytes_.size(), places_.size(),
                               short_number_text(places_.back().t)));
}

void Recording::take(char kind, std::size_t begin, std::size_t size) {
  using namespace recording_format;
  if (kind == kHeader) {
    Memory memory(bytes_.substr(begin, size));
    visit(memory, header_);
    has_header_ = true;
  } else if (kind == kName) {
    names_.push_back(bytes_.substr(begin, size));
  } else if (kind == kMomentumName) {
    momentum_names_.push_back(bytes_.substr(begin, size));
  } else if (kind == kAlarm) {
    alarms_.push_back(bytes_.substr(begin, size));
  } else if (kind == kEnd) {
    end_ = bytes_.substr(begin, size);
  } else if (kind == kFrame) {
    Memory memory(bytes_.substr(begin, 16));
    long step = 0;
    double t = 0;
    memory.visit(step);
    memory.visit(t);
    places_.push_back({begin, size, t});
  }
}

// A right checksum says that the bytes are as they were written, not that they make sense.
RecordedFrame Recording::frame(std::size_t n) const {
  RecordedFrame frame;
  bool fits = true;
  try {
    Memory memory(bytes_.substr(places_[n].begin, places_[n].size));
    visit(memory, frame);
    fits = memory.at_end();
  } catch (const std::runtime_error&) {
    fits = false;
  }
  const auto all_below = [](const std::vector<std::uint32_t>& numbers, std::size_t count) {
    return std::all_of(numbers.begin(), numbers.end(), [&](std::uint32_t i) { return i < count; });
  };
  fits = fits && frame.values.size() == header_.columns.size() &&
         frame.pulls.size() <= header_.couplings.size() &&
         frame.works.size() == frame.rows.size() && all_below(frame.rows, names_.size()) &&
         frame.momenta.size() == 2 * frame.momentum_rows.size() &&
         all_below(frame.momentum_rows, momentum_names_.size());
  if (!fits)
    throw InputError(
        {{file_, 0, fmt::format("frame {}, at byte {}", n, places_[n].begin),
          "its checksum is right, but its numbers do not fit the header", "record it again"}});
  return frame;
}

std::size_t Recording::at(double t, const std::string& option) const {
  const double slack = 1e-6 * std::min(header_.step, 1e-3);  // sums of steps are rounded
  const double first = places_.front().t, last = places_.back().t;
  if (!(t >= first - slack && t <= last + slack))
    throw InputError({{file_, 0, option,
                       short_number_text(t) + " s is not in the recording, which goes from " +
                           short_number_text(first) + " to " + short_number_text(last) + " s",
                       "give a time within"}});
  const auto after = std::upper_bound(places_.begin() + 1, places_.end(), t + slack,
                                      [](double end, const Place& place) { return end < place.t; });
  return static_cast<std::size_t>(after - places_.begin()) - 1;
}

}  // namespace twinarm
