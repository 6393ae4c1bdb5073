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
struct HandStep {
  double t = 0, h = 0;  // [s]
  HandSample hand;
};

class DeviceMotion final : public OperatorMotion {
 public:
  // Ring buffer of `capacity` steps, at least one; no allocation afterwards.
  explicit DeviceMotion(std::size_t capacity, const HandMapping& mapping = {})
      : mapping_(mapping), steps_(std::max<std::size_t>(1, capacity)) {}
  // The target of a step that begins at t, in ascending order.
  void set(const HandTarget& target, double t, double h) noexcept;
  void set(const HandStep& step) noexcept;
  const HandStep& newest() const { return at(count_ - 1); }
  // The stored steps, oldest first.
  std::vector<HandStep> steps() const;
  // At rest before the first step and after the newest one.
  HandSample sample(double t, double toward) const override;
  // To the end of the newest step [s].
  double duration() const override { return count_ == 0 ? 0 : newest().t + newest().h; }
  std::string description() const override { return "an input device"; }

 private:
  const HandStep& at(std::size_t n) const { return steps_[n % steps_.size()]; }

  HandMapping mapping_;
  std::vector<HandStep> steps_;  // a ring
  std::size_t count_ = 0;        // of all that were set
};

// Motion log of a live run as a CSV file, for a bit-identical replay. Columns
//   t[s], h[s], theta1[rad] .. theta6[rad], theta1_dot[rad/s] .. theta6_dot[rad/s], button
// one line per step, exact digits. Unlike a trace (coupling/target/recorded_trace.h) nothing is
// interpolated.
std::string hand_log_header();
std::string hand_log_line(const HandStep& step);

// Writes all stored steps to a temporary name, then renames the file.
void write_hand_log(const DeviceMotion& hand, const std::filesystem::path& file);

// Whether the file has the header of a log (not of a trace). False if it cannot be read.
bool is_hand_log(const std::filesystem::path& file);
// Throws one InputError with all errors of the file. An incomplete last line is ignored.
std::unique_ptr<DeviceMotion> read_hand_log(const std::filesystem::path& file);

// Reads a log or a trace. Throws InputError with all errors of the file.
std::unique_ptr<OperatorMotion> read_hand_file(const std::filesystem::path& file);

}  // namespace twinarm
