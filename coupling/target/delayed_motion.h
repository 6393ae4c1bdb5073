// Another hand, seen late and played faster: sample(t) is that of s = speed (t - delay); before the
// delay has passed it is the start of the motion, at rest. A real delay: no number of steps.
//
// The velocity is the other hand's own at s, times the speed (d/dt of what is seen), and zero
// before the delay has passed. Whether a step at that instant is before or after it is said by
// `toward`, as at any other corner.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "coupling/target/operator_motion.h"

namespace twinarm {

class PacedHand final : public HandSource {
 public:
  // delay >= 0 [s], speed > 0. A hand that is lent must outlive it.
  PacedHand(std::unique_ptr<HandSource> hand, double delay, double speed)
      : owned_(std::move(hand)), hand_(*owned_), delay_(delay), speed_(speed) {}
  PacedHand(const HandSource& hand, double delay, double speed)
      : hand_(hand), delay_(delay), speed_(speed) {}

  HandSample sample(double t, double toward) const override {
    constexpr double kSame = 1e-9;  // [s]; an instant that a sum of steps meets to rounding
    const double late = t - delay_, late_toward = toward - delay_;
    const bool waits = late < -kSame || (late < kSame && late + late_toward < 0);
    HandSample seen = waits ? hand_.sample(0, 1)
                            : hand_.sample(speed_ * std::max(late, 0.0), speed_ * late_toward);
    for (double& rate : seen.theta_dot) rate *= waits ? 0 : speed_;
    return seen;
  }
  double duration() const override { return delay_ + hand_.duration() / speed_; }
  std::string description() const override {
    return hand_.description() + "; " + std::to_string(delay_) + " s late, " +
           std::to_string(speed_) + " times as fast";
  }

 private:
  std::unique_ptr<HandSource> owned_;
  const HandSource& hand_;
  double delay_, speed_;
};

}  // namespace twinarm
