// DelayedMotion against the same motion defined with delay and speed.
#include "coupling/target/operator_motion.h"

#include <doctest/doctest.h>

#include <memory>

#include "tests/coupling/batch/single_runs.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

const OperatorMapping kPacedMapping;

// 0.3 + 2 t: non-zero initial position and velocity.
class PacedRamp final : public OperatorMotion {
 public:
  OperatorSample sample(double t, double) const override {
    OperatorSample hand;
    kPacedMapping.set_robot_angle(hand, 0, 0.3 + 2 * t, 2);
    return hand;
  }
  double duration() const override { return 3; }
  std::string description() const override { return "ramp"; }
};

double paced_angle(const OperatorMotion& hand, double t, double toward) {
  return kPacedMapping.robot_angle(hand.sample(t, toward), 0);
}
double paced_rate(const OperatorMotion& hand, double t, double toward) {
  return kPacedMapping.robot_rate(hand.sample(t, toward), 0);
}

}  // namespace

TEST_CASE("a delayed motion is at s = speed (t - delay) with rates times speed") {
  Random random(91);
  const WavingHand waving;
  for (int n = 0; n < 300; ++n) {
    const double delay = random.uniform(0, 0.3), speed = random.uniform(0.2, 4);
    const double t = random.uniform(0, 1.5);
    if (std::abs(t - delay) < 1e-6) continue;
    const OperatorSample seen = DelayedMotion(waving, delay, speed).sample(t, t + 1e-3);
    const OperatorSample wanted = WavingHand(speed, delay).sample(t, t + 1e-3);
    for (std::size_t j = 0; j < 3; ++j) {
      CHECK(std::abs(kPacedMapping.robot_angle(seen, j) - kPacedMapping.robot_angle(wanted, j)) <
            1e-13);
      CHECK(std::abs(kPacedMapping.robot_rate(seen, j) - kPacedMapping.robot_rate(wanted, j)) <
            1e-12);
    }
  }
}

TEST_CASE("before its delay a delayed motion is at rest at the start") {
  const DelayedMotion hand(std::make_unique<PacedRamp>(), 0.3, 1.5);
  for (const double t : {0.0, 0.1, 0.2999}) {
    CHECK(paced_angle(hand, t, t + 1e-4) == doctest::Approx(0.3).epsilon(1e-15));
    CHECK(paced_rate(hand, t, t + 1e-4) == 0);
  }
  const double met = 0.1 + 0.1 + 0.1;  // 0.30000000000000004, as a sum of steps
  for (const double t : {0.3, met, 0.6 - met}) {
    CHECK(paced_angle(hand, t, t + 0.1) == doctest::Approx(0.3).epsilon(1e-14));
    CHECK(paced_rate(hand, t, t - 0.1) == 0);
    CHECK(paced_rate(hand, t, t + 0.1) == doctest::Approx(3).epsilon(1e-15));
  }
  CHECK(paced_angle(hand, 0.5, 0.6) == doctest::Approx(0.3 + 2 * 1.5 * 0.2).epsilon(1e-14));
  CHECK(hand.duration() == doctest::Approx(0.3 + 3 / 1.5).epsilon(1e-15));
}

TEST_CASE("velocity jumps of a delayed motion are those of the other, one-sided for each step") {
  const AutomaticMotion motion{kPacedMapping};  // sweeps of a second
  const DelayedMotion hand(motion, 0.25, 4);
  for (const double corner : {1.0, 2.0}) {
    const double t = 0.25 + corner / 4;
    CHECK(paced_rate(hand, t, t - 0.01) ==
          doctest::Approx(4 * paced_rate(motion, corner, corner - 0.01)));
    CHECK(paced_rate(hand, t, t + 0.01) ==
          doctest::Approx(4 * paced_rate(motion, corner, corner + 0.01)));
    CHECK(paced_rate(hand, t, t - 0.01) == doctest::Approx(-paced_rate(hand, t, t + 0.01)));
    CHECK(paced_angle(hand, t, t + 0.01) ==
          doctest::Approx(paced_angle(motion, corner, corner + 0.01)));
  }
}
