// A hand that is known only up to now: the newest target of a device, as a OperatorMotion.
//
// A step [t, t + h] needs the KVR at its end, which nobody knows yet: x_K' = x_K + h v_K of the
// newest target. Nothing is invented beyond one step: a target that is not renewed stands still.
//
// The last targets are kept, so that a coupling may see them late
// (coupling/target/operator_motion.h). With room for all of them the same class plays a run again,
// with the same bits.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "coupling/device/device_mapping.h"
#include "coupling/target/operator_motion.h"

namespace twinarm {

// Device angles and rates that turn the KVR in the step [t, t + h].
struct HandStep {
  double t = 0, h = 0;  // [s]
  HandSample hand;
};

class DeviceMotion final : public OperatorMotion {
 public:
  // Remembers so many steps, at least one; no allocation from then on.
  explicit DeviceMotion(std::size_t remembered, const HandMapping& mapping = {});
  // The target of the step that begins at t, later than all before.
  void set(const HandTarget& target, double t, double h) noexcept;
  void set(const HandStep& step) noexcept;
  const HandStep& newest() const { return at(count_ - 1); }
  // Those that are remembered, the oldest first.
  std::vector<HandStep> steps() const;
  // Before the first step it rests where that begins; after the newest where that ends.
  HandSample sample(double t, double toward) const override;
  double duration() const override;  // to the end of the newest step [s]
  std::string description() const override { return "a hand device"; }

 private:
  const HandStep& at(std::size_t n) const { return steps_[n % steps_.size()]; }

  HandMapping mapping_;
  std::vector<HandStep> steps_;  // a ring
  std::size_t count_ = 0;        // of all that were set
};

// What a hand did in a live run, step by step, as a CSV file: from it the run can be made again
// with the same bits, recorded and inspected. Columns
//   t[s], h[s], theta1[rad] .. theta6[rad], theta1_dot[rad/s] .. theta6_dot[rad/s], button
// with 17 digits. Unlike a trace (coupling/target/recorded_trace.h) nothing is interpolated: each
// line is what the kinematic robot was told for one step.
std::string hand_log_header();
std::string hand_log_line(const HandStep& step);

// All steps that the hand remembers, to a temporary name, then renamed.
void write_hand_log(const DeviceMotion& hand, const std::filesystem::path& file);

// Whether the file's header is that of a log, and not of a trace. False where it cannot be read.
bool is_hand_log(const std::filesystem::path& file);
// Throws one InputError with every fault of the file. A torn last line, of a run that was killed,
// is left out.
std::unique_ptr<DeviceMotion> read_hand_log(const std::filesystem::path& file);

// The hand of a file, log or trace. Throws InputError with all of its faults.
std::unique_ptr<OperatorMotion> read_hand_file(const std::filesystem::path& file);

}  // namespace twinarm
