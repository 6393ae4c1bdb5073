#include "app/record/frame_coder.h"

#include <zstd.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace twinarm {
namespace {

constexpr int kLevel = 1;
constexpr std::size_t kWord = sizeof(std::uint64_t);
// Instead of a length: the difference as many words before as a RecordedContact has. The contacts
// of a pair share a normal.
constexpr unsigned kRepeated = 9;
constexpr std::size_t kPeriod = 14;

[[noreturn]] void reject() {
  throw std::runtime_error("a block is not compressed as it should be");
}

// Small differences of either sign become small numbers: 0, -1, 1, -2, ...
std::uint64_t zigzag(std::uint64_t difference) {
  return (difference << 1) ^ (0 - (difference >> 63));
}
std::uint64_t difference_of(std::uint64_t zigzag) {
  return (zigzag >> 1) ^ (0 - (zigzag & 1));
}

}  // namespace

std::string compressed(std::string_view bytes) {
  thread_local const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(),
                                                                                  ZSTD_freeCCtx);
  std::string result(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size = ZSTD_compressCCtx(context.get(), result.data(), result.size(),
                                             bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size)) throw std::runtime_error(ZSTD_getErrorName(size));
  result.resize(size);
  return result;
}

std::string decompressed(std::string_view bytes, std::size_t max) {
  thread_local const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(),
                                                                                  ZSTD_freeDCtx);
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (size > max) reject();  // as the values for unknown sizes and errors are
  std::string result(size, '\0');
  if (ZSTD_decompressDCtx(context.get(), result.data(), size, bytes.data(), bytes.size()) != size)
    reject();
  return result;
}

void FrameCoder::begin(std::size_t size) {
  const std::size_t words = (size + kWord - 1) / kWord;
  is_new_size_ = words != before_.size();
  for (auto* frame : {&words_, &before_, &earlier_, &differences_}) frame->resize(words);
}

// A frame of another size may have its parts at other places: its words are extrapolated as
// constant.
void FrameCoder::end() {
  if (is_new_size_)
    earlier_ = words_;
  else
    earlier_.swap(before_);
  before_.swap(words_);
}

std::string FrameCoder::encode(std::string_view frame) {
  begin(frame.size());
  if (!words_.empty()) words_.back() = 0;  // padding
  std::copy_n(frame.data(), frame.size(), reinterpret_cast<char*>(words_.data()));
  const std::size_t count = words_.size();
  for (std::size_t i = 0; i < count; ++i) differences_[i] = zigzag(words_[i] - prediction(i));
  const std::uint64_t size = frame.size();
  std::string lengths(kWord + (count + 1) / 2, '\0');
  std::memcpy(lengths.data(), &size, kWord);
  kept_.resize(kWord * (count + 1));
  const std::uint64_t* const differences = differences_.data();
  char *kept = kept_.data(), *pair = lengths.data() + kWord;
  // Without branches, which would be mispredicted.
  const auto keep = [&](std::size_t i) {
    const auto length = static_cast<unsigned>(std::bit_width(differences[i]) + 7) / 8;
    const std::size_t before = i < kPeriod ? i : i - kPeriod;
    const bool repeats = (before < i) & (length > 1) & (differences[i] == differences[before]);
    std::memcpy(kept, &differences[i], kWord);
    kept += repeats ? 0 : length;
    return repeats ? kRepeated : length;
  };
  std::size_t i = 0;
  for (; i + 1 < count; i += 2) {
    const unsigned first = keep(i), second = keep(i + 1);
    *pair++ = static_cast<char>(first | (second << 4));
  }
  if (i < count) *pair = static_cast<char>(keep(i));
  end();
  return compressed(lengths).append(kept_.data(), kept);
}

std::string FrameCoder::decode(std::string_view bytes, std::size_t max) {
  const std::size_t start = ZSTD_findFrameCompressedSize(bytes.data(), bytes.size());
  if (ZSTD_isError(start)) reject();
  const std::string lengths = decompressed(bytes.substr(0, start), max);
  std::uint64_t size = 0;
  if (lengths.size() < kWord) reject();
  std::memcpy(&size, lengths.data(), kWord);
  if (size > max || (size + 2 * kWord - 1) / (2 * kWord) != lengths.size() - kWord) reject();
  begin(size);
  kept_.assign(bytes.begin() + static_cast<std::ptrdiff_t>(start), bytes.end());
  std::size_t at = 0, left = kept_.size();
  kept_.resize(left + kWord);
  for (std::size_t i = 0; i < words_.size(); ++i) {
    const auto pair = static_cast<unsigned char>(lengths[kWord + i / 2]);
    const unsigned length = (pair >> (4 * (i % 2))) % 16;
    if (length == kRepeated && i >= kPeriod) {
      differences_[i] = differences_[i - kPeriod];
    } else {
      if (length > kWord || length > left) reject();
      std::uint64_t difference = 0;
      std::memcpy(&difference, kept_.data() + at, kWord);
      if (length < kWord) difference &= (std::uint64_t{1} << (8 * length)) - 1;
      differences_[i] = difference;
      at += length;
      left -= length;
    }
    words_[i] = prediction(i) + difference_of(differences_[i]);
  }
  if (left > 0) reject();
  std::string frame(reinterpret_cast<const char*>(words_.data()), size);
  end();
  return frame;
}

}  // namespace twinarm
