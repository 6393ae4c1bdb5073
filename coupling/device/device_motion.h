// The motion of a live device as an OperatorMotion, and its log.
//
// A step [t, t + h] needs the KVR at its end: extrapolated over one step from the newest target,
// x_K' = x_K + h v_K; a target that is not renewed stays. The last targets are kept for couplings
// with delay (coupling/target/operator_motion.h); with capacity for all of them, a run can be
// replayed bit-identically.
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "coupling/device/device_mapping.h"
#include "coupling/target/operator_motion.h"

namespace twinarm {

// Device angles and rates of the step [t, t + h].
struct DeviceStep {
  double t = 0, h = 0;  // [s]
  OperatorSample sample;
};

class DeviceMotion final : public OperatorMotion {
 public:
  // Ring buffer of `capacity` steps, at least one; no allocation afterwards.
  explicit DeviceMotion(std::size_t capacity, const OperatorMapping& mapping = {})
      : mapping_(mapping), steps_(std::max<std::size_t>(1, capacity)) {}
  // The target of a step that begins at t, in ascending order; replaces one at the same t.
  void set(const MappedTarget& target, double t, double h) noexcept;
  void set(const DeviceStep& step) noexcept;
  const DeviceStep& newest() const { return at(count_ - 1); }
  // The stored steps, oldest first.
  std::vector<DeviceStep> steps() const;
  // At rest before the first step and after the newest one.
  OperatorSample sample(double t, double toward) const override;
  // To the end of the newest step [s].
  double duration() const override { return count_ == 0 ? 0 : newest().t + newest().h; }
  std::string description() const override { return "an input device"; }

 private:
  const DeviceStep& at(std::size_t n) const { return steps_[n % steps_.size()]; }

  OperatorMapping mapping_;
  std::vector<DeviceStep> steps_;  // a ring
  std::size_t count_ = 0;          // of all that were set
};

// Motion log of a live run as a CSV file, for a bit-identical replay. Columns
//   t[s], h[s], theta1[rad] .. theta6[rad], theta1_dot[rad/s] .. theta6_dot[rad/s], button
// one line per step, exact digits. Unlike a trace (coupling/target/recorded_trace.h) nothing is
// interpolated.
std::string device_log_header();
std::string device_log_line(const DeviceStep& step);

// Writes all stored steps to a temporary name, then renames the file.
void write_device_log(const DeviceMotion& motion, const std::filesystem::path& file);

// Whether the file has the header of a log (not of a trace). False if it cannot be read.
bool is_device_log(const std::filesystem::path& file);
// Throws one InputError with all errors of the file. An incomplete last line is ignored.
std::unique_ptr<DeviceMotion> read_device_log(const std::filesystem::path& file);

// Reads a log or a trace. Throws InputError with all errors of the file.
std::unique_ptr<OperatorMotion> read_motion_file(const std::filesystem::path& file);

}  // namespace twinarm
