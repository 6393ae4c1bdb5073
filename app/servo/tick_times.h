// How long ticks took: a histogram that costs a few instructions to add to, and never allocates.
//
// Bins are a sixteenth of an octave wide, from 50 ns to 13 s; a quantile is the upper edge of its
// bin, so it is never told too small, and at most 4.5 % too large. The largest value is kept
// exactly.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace twinarm {

class TickTimes {
 public:
  static constexpr int kBins = 28 * 16;
  static constexpr double kFirst = 50e-9;  // upper edge of the first bin [s]

  void add(double seconds) noexcept {
    const double bin = std::ceil(16 * std::log2(std::max(seconds, kFirst) / kFirst));
    ++counts_[static_cast<std::size_t>(std::min(bin, kBins - 1.0))];
    ++count_;
    sum_ += seconds;
    largest_ = std::max(largest_, seconds);
  }
  static double upper_edge(int bin) { return kFirst * std::exp2(bin / 16.0); }
  long count() const { return count_; }
  long count(int bin) const { return counts_[static_cast<std::size_t>(bin)]; }
  double largest() const { return largest_; }
  double mean() const { return count_ ? sum_ / static_cast<double>(count_) : 0; }
  // The least edge that a share p of all values does not pass [s]; 0 where there are none.
  double quantile(double p) const {
    const double wanted = p * static_cast<double>(count_);
    long below = 0;
    for (int bin = 0; bin < kBins; ++bin) {
      below += count(bin);
      if (below > 0 && static_cast<double>(below) >= wanted)
        return std::min(upper_edge(bin), largest_);
    }
    return largest_;
  }

 private:
  std::array<long, kBins> counts_{};
  long count_ = 0;
  double sum_ = 0, largest_ = 0;
};

}  // namespace twinarm
