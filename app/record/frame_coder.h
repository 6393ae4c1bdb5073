// Compression of frames (docs/reference/recording_file.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace twinarm {

std::string compressed(std::string_view bytes);  // a Zstandard frame
// Throws std::runtime_error if `bytes` are not one, or of more than `max` bytes when decompressed,
// before memory is allocated for them.
std::string decompressed(std::string_view bytes, std::size_t max);

// Codes each word of 8 bytes as its difference from the linear extrapolation of the two frames
// before, without the leading zero bytes of the difference. The numbers of bytes are compressed.
class FrameCoder {
 public:
  void restart() { before_.clear(), earlier_.clear(); }  // the next frame is a keyframe
  std::string encode(std::string_view frame);
  std::string decode(std::string_view bytes, std::size_t max);  // throws as decompressed()

 private:
  std::uint64_t prediction(std::size_t word) const { return 2 * before_[word] - earlier_[word]; }
  void begin(std::size_t size);
  void end();
  std::vector<std::uint64_t> words_, before_, earlier_, differences_;
  std::string kept_;  // bytes of the differences
  bool is_new_size_ = false;
};

}  // namespace twinarm
