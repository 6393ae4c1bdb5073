#include "coupling/target/recorded_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>

#include "solver/spatial/scalar.h"
#include "solver/support/atomic_file.h"
#include "solver/support/diagnostics.h"
#include "solver/support/input_file.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

constexpr std::array<const char*, 7> kColumns{"t[s]",        "theta1[rad]", "theta2[rad]",
                                              "theta3[rad]", "theta4[rad]", "theta5[rad]",
                                              "theta6[rad]"};
constexpr std::size_t kMaxTraceFaults = 20;                // reported errors of one file
constexpr std::size_t kMaxSamples = std::size_t{1} << 23;  // two hours at 1 kHz

// Limits of the Omni's joints, theta3 relative to theta2 or to the world [rad]. A trace may be of
// another device: values beyond kBeyond times a limit give a warning, beyond a revolution an error.
constexpr std::array<double, 6> kJointEnd{0.98, 1.75, 3.0, 2.45, 1.75, 2.58};
constexpr double kBeyond = 1.5;
constexpr double kRevolution = 2 * std::numbers::pi;
constexpr double kFewRadians = 3.5;  // smaller values in degrees are probably radians
constexpr double kGapIntervals = 3, kJitterShare = 0.25;  // warning thresholds, in median intervals

std::string degree_column(std::size_t joint) {
  return fmt::format("theta{}[deg]", joint + 1);
}

}  // namespace

// Reads a file into a trace; collects all errors.
class TraceReader {
 public:
  explicit TraceReader(RecordedTrace& trace) : trace_(trace) {}
  void read(std::istream& stream) {
    int line_number = 0;
    for (std::string line; next_line(stream, line, trace_.file_, line_number + 1);) {
      if (++line_number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // Excel's BOM
      const Cells cells = csv_cells(line);
      const bool blank = cells.empty() || (cells.size() == 1 && cells[0].empty());
      if (blank || cells[0].starts_with("#")) continue;
      if (header_line_ == 0)
        read_header(line_number, cells);
      else
        read_sample(line_number, cells);
    }
    if (fault_count_ == 0 && trace_.samples_.size() < 2)
      add(0, "", "the trace has fewer than two samples",
          "give a header line and at least two lines");
    check_angles();
    if (const auto more = fault_count_ - std::min(fault_count_, kMaxTraceFaults))
      faults_.add({trace_.file_, 0, "", fmt::format("and {} more errors", more),
                   "correct those above first", "trace.more"});
    faults_.check();
    measure();
    const double start = trace_.samples_.front().t;
    for (RecordedTrace::Sample& sample : trace_.samples_) sample.t -= start;
  }

 private:
  using Cells = std::vector<std::string_view>;
  void add(int line, const std::string& where, const std::string& problem, const std::string& fix) {
    if (++fault_count_ <= kMaxTraceFaults)
      faults_.add({trace_.file_, line, where, problem, fix, "trace.value"});
  }
  std::string column_name(std::size_t joint) const {
    return in_degrees_[joint] ? degree_column(joint) : kColumns[joint + 1];
  }
  void read_header(int line, const Cells& cells) {
    header_line_ = line;
    const auto find = [&](const std::string& name) {
      return static_cast<std::size_t>(std::find(cells.begin(), cells.end(), name) - cells.begin());
    };
    for (std::size_t c = 0; c < kColumns.size(); ++c) {
      column_[c] = find(kColumns[c]);
      if (column_[c] < cells.size()) continue;
      if (c > 0) column_[c] = find(degree_column(c - 1));
      if (column_[c] < cells.size())
        in_degrees_[c - 1] = true;
      else
        add(line, "header", fmt::format("column '{}' is missing", kColumns[c]),
            "give the columns t[s], theta1[rad] to theta6[rad] (or [deg]), and button if there is "
            "one");
    }
    column_[7] = find("button");
    have_button_ = column_[7] < cells.size();
    faults_.check();
  }
  void read_sample(int line, const Cells& cells) {
    RecordedTrace::Sample sample{};
    double button = 0;
    bool good = true, has_time = false;
    for (std::size_t c = 0; c < (have_button_ ? 8u : 7u); ++c) {
      double& value = c == 0 ? sample.t : c == 7 ? button : sample.theta[c - 1];
      const std::string_view cell = column_[c] < cells.size() ? cells[column_[c]] : "";
      if (const auto number = parse_number(cell)) {
        value = c > 0 && c < 7 && in_degrees_[c - 1] ? *number * kDegree : *number;
        has_time = has_time || c == 0;
        continue;
      }
      good = false;
      add(line,
          c == 7   ? "button"
          : c == 0 ? kColumns[0]
                   : column_name(c - 1),
          fmt::format("'{}' is not a finite number", cell), "correct or remove the line");
    }
    if (has_time && !(sample.t > last_time_)) {
      add(line, "t[s]",
          fmt::format("time does not increase: {} s after {} s", sample.t, last_time_),
          "sort the lines by time, one line per instant");
      good = false;
    } else if (has_time) {
      last_time_ = sample.t;
    }
    if (good && button != 0 && button != 1) {
      add(line, "button", fmt::format("'{:g}' is neither 0 nor 1", button), "give 0 or 1");
      good = false;
    }
    if (!good) return;
    sample.button = button != 0;
    auto& samples = trace_.samples_;
    if (samples.size() == kMaxSamples)
      throw InputError({{trace_.file_, line, "", "the trace has more than 8 million samples",
                         "shorten it, or use a lower sampling rate", "trace.too-long"}});
    samples.push_back(sample);
  }
  // Detects degrees in columns of radians: an error beyond a revolution, a warning beyond the
  // Omni's joint limits.
  void check_angles() {
    std::array<double, 6> max_angle{};
    for (const RecordedTrace::Sample& sample : trace_.samples_)
      for (std::size_t j = 0; j < 6; ++j)
        max_angle[j] = std::max(max_angle[j], std::abs(sample.theta[j]));
    bool fits_as_degrees = true;
    for (std::size_t j = 0; j < 6; ++j)
      if (!in_degrees_[j] && max_angle[j] * kDegree > kBeyond * kJointEnd[j])
        fits_as_degrees = false;
    double max_degrees = 0;
    for (std::size_t j = 0; j < 6; ++j) {
      const std::string name = fmt::format("theta{}", j + 1);
      if (max_angle[j] > kRevolution && (in_degrees_[j] || !fits_as_degrees)) {
        add(header_line_, column_name(j),
            fmt::format(
                "reaches {:.4g} rad, more than one revolution, impossible for an input device",
                max_angle[j]),
            "give radians, or degrees in columns theta1[deg] and so on");
      } else if (in_degrees_[j]) {
        max_degrees = std::max(max_degrees, max_angle[j] / kDegree);
      } else if (max_angle[j] > kRevolution) {
        add(header_line_, kColumns[j + 1],
            fmt::format("reaches {:.4g} rad, more than one revolution: probably degrees",
                        max_angle[j]),
            "name columns in degrees theta1[deg], theta2[deg], ...");
      } else if (max_angle[j] > kBeyond * kJointEnd[j]) {
        trace_.quality_.warnings.push_back(
            fmt::format("{} reaches {:.3g} rad, the joint limit of a Phantom Omni is about {:.3g}; "
                        "if these are degrees, name the column {}",
                        name, max_angle[j], kJointEnd[j], degree_column(j)));
      }
    }
    if (max_degrees > 0 && max_degrees < kFewRadians)
      trace_.quality_.warnings.push_back(
          fmt::format("the angles named [deg] stay below {:.2g} degrees; if these are radians, "
                      "name the columns theta1[rad] and so on",
                      max_degrees));
  }
  void measure() {
    TraceQuality& quality = trace_.quality_;
    const auto& samples = trace_.samples_;
    std::vector<double> intervals;
    for (std::size_t n = 1; n < samples.size(); ++n) {
      intervals.push_back(samples[n].t - samples[n - 1].t);
      if (intervals.back() <= quality.max_gap) continue;
      quality.max_gap = intervals.back();
      quality.gap_start = samples[n - 1].t;
    }
    const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
    std::nth_element(intervals.begin(), middle, intervals.end());
    quality.interval = *middle;
    quality.rate = 1 / quality.interval;
    double sum = 0, count = 0;
    long gaps = 0;
    for (double interval : intervals) {
      const double deviation = interval - quality.interval;
      if (interval > kGapIntervals * quality.interval)
        ++gaps;
      else
        sum += deviation * deviation, ++count;
    }
    quality.jitter = std::sqrt(sum / count);
    if (gaps > 0)
      quality.warnings.push_back(fmt::format(
          "{} gap{} longer than {:g} sampling intervals, the longest {:.3g} s at t = {:.6g} s; the "
          "motion is interpolated linearly",
          gaps, gaps == 1 ? "" : "s", kGapIntervals, quality.max_gap, quality.gap_start));
    if (quality.jitter > kJitterShare * quality.interval)
      quality.warnings.push_back(
          fmt::format("the sampling interval has a jitter of {:.2g} s about {:.3g} s, and so have "
                      "the velocities",
                      quality.jitter, quality.interval));
  }

  RecordedTrace& trace_;
  DiagnosticList faults_;
  std::size_t fault_count_ = 0;
  int header_line_ = 0;
  std::array<std::size_t, 8> column_{};  // of t, theta1..theta6, button
  std::array<bool, 6> in_degrees_{};
  bool have_button_ = false;
  double last_time_ = -HUGE_VAL;  // of the lines so far, also of those with other errors
};

RecordedTrace::RecordedTrace(const std::filesystem::path& file) : file_(file.string()) {
  std::ifstream stream = open_file(file);
  TraceReader(*this).read(stream);
}

OperatorSample RecordedTrace::sample(double t, double toward) const {
  // The interval of a step between t and toward.
  const double inside = t + 1e-9 * (toward - t);
  auto after = std::ranges::upper_bound(samples_, inside, {}, &Sample::t);
  after = std::clamp(after, samples_.begin() + 1, samples_.end() - 1);
  const Sample& a = *std::prev(after);
  const Sample& b = *after;
  OperatorSample sampled;
  const double s = std::clamp((t - a.t) / (b.t - a.t), 0.0, 1.0);
  const bool moving = t < samples_.back().t || toward < samples_.back().t;
  for (std::size_t j = 0; j < 6; ++j) {
    sampled.theta[j] = a.theta[j] + s * (b.theta[j] - a.theta[j]);
    sampled.theta_dot[j] = moving ? (b.theta[j] - a.theta[j]) / (b.t - a.t) : 0.0;
  }
  sampled.button = t >= b.t ? b.button : a.button;
  return sampled;
}

std::string RecordedTrace::description() const {
  return fmt::format("recorded trace {}, {} samples at {:.4g} Hz, {:.3g} s", file_, samples_.size(),
                     quality_.rate, duration());
}

void write_trace(const OperatorMotion& motion, double rate, const std::filesystem::path& file) {
  std::string text = "# " + motion.description() + "\n";
  for (const char* column : kColumns) text += fmt::format("{},", column);
  text += "button\n";
  const auto count = static_cast<long>(std::floor(motion.duration() * rate)) + 1;
  for (long n = 0; n < count; ++n) {
    const double t = static_cast<double>(n) / rate;
    const OperatorSample sample = motion.sample(t, t + 1 / rate);
    text += fmt::format("{:.6f}", t);
    for (double theta : sample.theta) text += fmt::format(",{:.6f}", theta);
    text += sample.button ? ",1\n" : ",0\n";
  }
  write_whole_file(file, text);
}

bool next_line(std::istream& stream, std::string& line, const std::string& file, int number) {
  std::array<char, 1 << 16> buffer;
  stream.getline(buffer.data(), buffer.size());
  const auto count = static_cast<std::size_t>(stream.gcount());
  if (stream.fail() && count + 1 == buffer.size())
    throw InputError({{file, number, "", "the line is longer than 64 KiB",
                       "give a CSV file of numbers", "file.long-line"}});
  const bool has_end = !stream.eof();
  line.assign(buffer.data(), count - (has_end && count > 0 ? 1 : 0));
  return !stream.fail();
}

std::vector<std::string_view> csv_cells(std::string_view line) {
  std::vector<std::string_view> cells;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(','), line.size());
    const std::string_view cell = line.substr(0, end);
    const auto first = cell.find_first_not_of(" \t\r"), last = cell.find_last_not_of(" \t\r");
    cells.push_back(first == cell.npos ? cell.substr(0, 0) : cell.substr(first, last - first + 1));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return cells;
}

}  // namespace twinarm
