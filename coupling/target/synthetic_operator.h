// Synthetic operator motion, not a recording of a person: minimum-jerk reaches (Flash and Hogan
// 1985) between random targets with pauses, and an 8 to 12 Hz tremor on every joint. The seed
// determines the motion, on every machine.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "coupling/target/operator_motion.h"

namespace twinarm {

// What the motion is drawn from.
struct SyntheticRanges {
  std::array<double, 2> peak_speed{1.5, 4.0};  // of the fastest joint, for each reach [rad/s]
  std::array<double, 2> tremor{0.004, 0.004};  // of each of three sines, once for an operator [rad]
  bool operator==(const SyntheticRanges&) const = default;
};

class SyntheticOperator final : public OperatorMotion {
 public:
  explicit SyntheticOperator(unsigned seed, double duration = 20.0,
                             const SyntheticRanges& ranges = {});
  OperatorSample sample(double t, double toward) const override;
  double duration() const override { return duration_; }
  std::string description() const override {
    return "synthetic operator (not a person), seed " + std::to_string(seed_) +
           ": minimum-jerk reaches between random targets, 8-12 Hz tremor";
  }

 private:
  struct Reach {
    double start, end;  // [s]
    std::array<double, 6> from, to;
    bool button;
  };
  struct Tremor {
    double amplitude, omega, phase;  // [rad], [rad/s], [rad]
  };
  unsigned seed_;
  double duration_;
  std::vector<Reach> reaches_;
  std::array<std::array<Tremor, 3>, 6> tremor_{};
};

}  // namespace twinarm
