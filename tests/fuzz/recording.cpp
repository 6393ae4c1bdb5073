// A recording: read as it is, and with its check sums made right, so that what they guard is
// reached; then its run is taken up again, where it is short.
#include <algorithm>
#include <cstring>

#include "app/record/record_run.h"
#include "app/record/recording_reader.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {
namespace {

using namespace recording_format;

std::string with_checksums(std::string bytes) {
  for (std::size_t at = kStart; at < bytes.size() && bytes.size() - at >= kBefore + kAfter;) {
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + at + 1, sizeof size);
    if (size > bytes.size() - at - kBefore - kAfter) break;
    const std::uint32_t sum = checksum(bytes.data() + at, kBefore + size);
    std::memcpy(bytes.data() + at + kBefore + size, &sum, sizeof sum);
    at += kBefore + size + kAfter;
  }
  return bytes;
}

void read_recording(const std::string& bytes) {
  goes_through([&] {
    const Recording read(folder().write("run.twinrec", bytes));
    long least = 0, most = 0;
    for (std::size_t n = 0; n < std::min<std::size_t>(read.size(), 20); ++n)
      goes_through([&] {
        const RecordedFrame frame = read.frame(n);
        least = std::min(least, frame.step), most = std::max(most, frame.step);
        goes_through([&] { read.at(frame.t, "--at"); });
      });
    constexpr long kShort = 50;
    if (most - least / 2 > kShort || least < 0 || read.size() > 20) return;
    for (const std::size_t first : {std::size_t{0}, read.size() - 1})
      goes_through([&] { replay(read, first, {}); });
  });
}

}  // namespace

void recording(Bytes bytes) {
  read_recording(std::string(bytes));
  const std::string right = with_checksums(std::string(bytes));
  if (right != bytes) read_recording(right);
}

}  // namespace twinarm::fuzz
