// A recorded hand, from a CSV file with a header line and the columns
//   t[s], theta1[rad], ..., theta6[rad], button        (button may be left out)
// in any order, at any rate; lines that begin with # are comments. Between samples the angles are
// interpolated linearly, so the rate is a staircase.
#pragma once

#include <filesystem>
#include <vector>

#include "coupling/hand.h"

namespace twinarm {

class RecordedTrace final : public HandSource {
 public:
  // Throws one InputError with every fault of the file: it cannot be read, columns are missing,
  // a value is not a finite number, time does not advance, fewer than two samples.
  explicit RecordedTrace(const std::filesystem::path& file);
  HandSample sample(double t, double toward) const override;
  double duration() const override { return samples_.back().t; }
  std::string description() const override;

 private:
  struct Sample {
    double t;
    std::array<double, 6> theta;
    bool button;
  };
  std::string file_;
  std::vector<Sample> samples_;  // the first at t = 0
};

// Writes samples of a source at a fixed rate [Hz], to a temporary name, then renamed.
void write_trace(const HandSource& hand, double rate, const std::filesystem::path& file);

}  // namespace twinarm
