// A recorded hand, from a CSV file with a header line and the columns
//   t[s], theta1[rad], ..., theta6[rad], button        (button may be left out)
// in any order, at any rate; lines that begin with # are comments. theta1[deg] and so on are taken
// for degrees and converted. Between samples the angles are interpolated linearly, so the rate is a
// staircase.
#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "coupling/target/operator_motion.h"

namespace twinarm {

// How a trace was sampled, and what a reader should know before believing a run on it.
struct TraceQuality {
  double interval = 0;  // median time between samples [s]
  double rate = 0;      // 1 / interval [Hz]
  // Longest time without a sample [s], and when it begins, on the file's clock [s].
  double max_gap = 0, gap_start = 0;
  // Root mean square of the intervals' deviations from their median, gaps left out [s].
  double jitter = 0;
  std::vector<std::string> warnings;  // sentences for people; empty for a clean trace
};

class RecordedTrace final : public OperatorMotion {
 public:
  // Throws one InputError with every fault of the file: it cannot be read, columns are missing,
  // a value is not a finite number, time does not advance, fewer than two samples, angles that no
  // joint can have (where they would be right as degrees, that is asked).
  explicit RecordedTrace(const std::filesystem::path& file);
  HandSample sample(double t, double toward) const override;
  double duration() const override { return samples_.back().t; }
  std::string description() const override;
  const TraceQuality& quality() const { return quality_; }

 private:
  struct Sample {
    double t;
    std::array<double, 6> theta;
    bool button;
  };
  friend class TraceReader;
  std::string file_;
  std::vector<Sample> samples_;  // the first at t = 0
  TraceQuality quality_;
};

// Writes samples of a source at a fixed rate [Hz], to a temporary name, then renamed.
void write_trace(const OperatorMotion& hand, double rate, const std::filesystem::path& file);

// Lines of a file that may be hostile.

// As std::getline; throws InputError, naming `file` and line `number`, where the line has more than
// 64 KiB: a file without ends of lines is not read whole.
bool next_line(std::istream& stream, std::string& line, const std::string& file, int number);

// What stands between its commas, without the blanks about it.
std::vector<std::string_view> csv_cells(std::string_view line);

}  // namespace twinarm
