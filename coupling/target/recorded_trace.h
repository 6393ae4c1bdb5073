// A recorded operator motion, from a CSV file with a header line and the columns
//   t[s], theta1[rad], ..., theta6[rad], button        (button may be left out)
// in any order, at any sampling rate; lines that begin with # are comments. Columns theta1[deg] and
// so on are in degrees. Angles are interpolated linearly, so rates are piecewise constant.
#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "coupling/target/operator_motion.h"

namespace twinarm {

// Sampling quality of a trace.
struct TraceQuality {
  double interval = 0;  // median time between samples [s]
  double rate = 0;      // 1 / interval [Hz]
  // Longest interval between samples [s], and its start on the file's clock [s].
  double max_gap = 0, gap_start = 0;
  // RMS deviation of the intervals from their median, without gaps [s].
  double jitter = 0;
  std::vector<std::string> warnings;  // empty for a clean trace
};

class RecordedTrace final : public OperatorMotion {
 public:
  // Throws one InputError with all errors of the file: unreadable, missing columns, values that are
  // not finite numbers, time that does not increase, fewer than two samples, impossible angles.
  explicit RecordedTrace(const std::filesystem::path& file);
  OperatorSample sample(double t, double toward) const override;
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

// Writes samples of a motion at a fixed rate [Hz], to a temporary name, then renamed.
void write_trace(const OperatorMotion& motion, double rate, const std::filesystem::path& file);

// As std::getline; throws InputError, with `file` and line `number`, for a line longer than 64 KiB.
bool next_line(std::istream& stream, std::string& line, const std::string& file, int number);

// Cells of a CSV line, without surrounding blanks.
std::vector<std::string_view> csv_cells(std::string_view line);

}  // namespace twinarm
