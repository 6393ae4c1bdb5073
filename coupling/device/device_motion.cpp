#include "coupling/device/device_motion.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "coupling/target/recorded_trace.h"
#include "solver/support/atomic_file.h"
#include "solver/support/diagnostics.h"
#include "solver/support/input_file.h"
#include "solver/support/number_text.h"

namespace twinarm {

void DeviceMotion::set(const MappedTarget& target, double t, double h) noexcept {
  DeviceStep step{t, h, {}};
  for (std::size_t j = 0; j < std::min<std::size_t>(3, target.q.size()); ++j)
    mapping_.set_robot_angle(step.sample, j, target.q[j], target.qd[j]);
  step.sample.button = target.gripper_closed;
  set(step);
}

void DeviceMotion::set(const DeviceStep& step) noexcept {
  if (count_ > 0 && newest().t == step.t) --count_;
  steps_[count_++ % steps_.size()] = step;
}

OperatorSample DeviceMotion::sample(double t, double toward) const {
  if (count_ == 0) return {};
  // The step that contains an instant just inside, from the side of `toward`: binary search.
  double inside = t + 1e-9 * (toward - t);
  if (inside == t)
    inside = std::nextafter(t, toward);  // 1e-9 of a step is below an ulp of a large t
  const std::size_t oldest = count_ - std::min(count_, steps_.size());
  std::size_t low = oldest, high = count_;
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (at(middle).t <= inside ? low : high) = middle;
  }
  const DeviceStep& step = at(low);
  OperatorSample sampled = step.sample;
  const double since = std::clamp(t - step.t, 0.0, step.h);
  for (std::size_t j = 0; j < 6; ++j) sampled.theta[j] += since * sampled.theta_dot[j];
  const bool rests = inside < step.t || inside > step.t + step.h;
  if (rests) sampled.theta_dot.fill(0);
  return sampled;
}

std::vector<DeviceStep> DeviceMotion::steps() const {
  std::vector<DeviceStep> all;
  for (std::size_t n = count_ - std::min(count_, steps_.size()); n < count_; ++n)
    all.push_back(at(n));
  return all;
}

namespace {

constexpr std::size_t kMaxLogSteps = std::size_t{1} << 22;  // an hour at 1 kHz
constexpr std::size_t kLogColumns = 15;                     // t, h, six angles, six rates, button

// All numbers of the line; empty if a cell is not a number.
std::vector<double> log_numbers(const std::string& line) {
  std::vector<double> values;
  for (const std::string_view cell : csv_cells(line)) {
    const auto number = parse_number(cell);
    if (!number) return {};
    values.push_back(*number);
  }
  return values;
}

DeviceStep step_of(const std::vector<double>& values) {
  DeviceStep step{values[0], values[1], {}};
  for (std::size_t j = 0; j < 6; ++j) {
    step.sample.theta[j] = values[2 + j];
    step.sample.theta_dot[j] = values[8 + j];
  }
  step.sample.button = values[14] != 0;
  return step;
}

}  // namespace

std::string device_log_header() {
  std::string text = "t[s],h[s]";
  for (int j = 1; j <= 6; ++j) text += fmt::format(",theta{}[rad]", j);
  for (int j = 1; j <= 6; ++j) text += fmt::format(",theta{}_dot[rad/s]", j);
  return text + ",button\n";
}

std::string device_log_line(const DeviceStep& step) {
  std::string text = fmt::format("{},{}", step.t, step.h);  // shortest exact digits
  for (const double angle : step.sample.theta) text += fmt::format(",{}", angle);
  for (const double rate : step.sample.theta_dot) text += fmt::format(",{}", rate);
  return text + (step.sample.button ? ",1\n" : ",0\n");
}

void write_device_log(const DeviceMotion& motion, const std::filesystem::path& file) {
  std::string text = device_log_header();
  for (const DeviceStep& step : motion.steps()) text += device_log_line(step);
  write_whole_file(file, text);
}

bool is_device_log(const std::filesystem::path& file) {
  const std::string header = device_log_header();
  std::string start(header.size(), '\0');
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  std::ifstream stream(file);
  return stream.read(start.data(), static_cast<std::streamsize>(start.size())) && start == header;
}

std::unique_ptr<DeviceMotion> read_device_log(const std::filesystem::path& file) {
  std::ifstream stream = open_file(file);
  if (!is_device_log(file))
    throw InputError({{file.string(), 1, "header", "the header is not that of a motion log",
                       "give a file written by `twinarm hand --log`", "hand.header"}});
  std::string line;
  next_line(stream, line, file.string(), 1);
  std::vector<DeviceStep> steps;
  DiagnosticList faults;
  for (int number = 2; next_line(stream, line, file.string(), number); ++number) {
    if (steps.size() == kMaxLogSteps) {
      faults.add({file.string(), number, "", "the log has more than 4 million steps",
                  "remove the lines from here on", "hand.too-long"});
      break;
    }
    if (stream.eof()) break;  // incomplete last line
    const std::vector<double> values = log_numbers(line);
    if (values.size() != kLogColumns || !(values[1] > 0)) {
      faults.add({file.string(), number, "",
                  "expected 15 finite numbers with h > 0, found " + std::to_string(values.size()),
                  "remove the lines from here on", "hand.row"});
      break;
    }
    if (!steps.empty() && !(values[0] > steps.back().t)) {
      faults.add({file.string(), number, "t[s]",
                  fmt::format("time does not increase: {} s after {} s", values[0], steps.back().t),
                  "remove the lines from here on", "hand.time"});
      break;
    }
    steps.push_back(step_of(values));
  }
  if (steps.empty() && faults.empty())
    faults.add({file.string(), 0, "", "the log has no steps", "record a run of at least one step",
                "hand.empty"});
  faults.check();
  auto motion = std::make_unique<DeviceMotion>(steps.size());
  for (const DeviceStep& step : steps) motion->set(step);
  return motion;
}

std::unique_ptr<OperatorMotion> read_motion_file(const std::filesystem::path& file) {
  if (is_device_log(file)) return read_device_log(file);
  return std::make_unique<RecordedTrace>(file);
}

}  // namespace twinarm
