// Scripted hands for experiments, beside the paper's automatic motion: a step, a chirp, a
// minimum-jerk reach. Each moves the device's angles about a posture; t = 0 is their beginning.
#pragma once

#include "coupling/target/operator_motion.h"

namespace twinarm {

using HandAngles = std::array<double, 6>;  // theta1..theta6 of the device [rad]

// Rests at `from`, jumps to `to` at the time `at`, rests there. The rate is zero throughout: a
// jump has none. At the instant itself the angles are those of the side that is asked for.
class StepMotion final : public OperatorMotion {
 public:
  StepMotion(const HandAngles& from, const HandAngles& to, double at, double duration);
  HandSample sample(double t, double toward) const override;
  double duration() const override { return duration_; }
  std::string description() const override;

 private:
  HandAngles from_, to_;
  double at_, duration_;
};

// theta_j = middle_j + amplitude_j sin(phi), phi = 2 pi (f0 t + (f1 - f0) t^2 / (2 T)): from f0 to
// f1 [Hz] in T [s], linearly in time. Begins with a corner (the rate jumps) and rests after T where
// it was.
class ChirpMotion final : public OperatorMotion {
 public:
  ChirpMotion(const HandAngles& middle, const HandAngles& amplitude, double f0, double f1,
              double T);
  HandSample sample(double t, double toward) const override;
  double duration() const override { return duration_; }
  std::string description() const override;

 private:
  HandAngles middle_, amplitude_;
  double f0_, f1_, duration_;
};

// From one posture to another on the path of least jerk (Flash and Hogan 1985),
// s^3 (10 - 15 s + 6 s^2): it begins at `at`, takes T [s], and rests before and after.
class ReachMotion final : public OperatorMotion {
 public:
  ReachMotion(const HandAngles& from, const HandAngles& to, double at, double T);
  HandSample sample(double t, double toward) const override;
  double duration() const override { return at_ + T_; }
  std::string description() const override;

 private:
  HandAngles from_, to_;
  double at_, T_;
};

}  // namespace twinarm
