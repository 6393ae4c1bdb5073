// Scripted motions of the device angles: step, chirp, minimum-jerk reach; t = 0 is the start.
#pragma once

#include <algorithm>

#include "coupling/target/operator_motion.h"

namespace twinarm {

using DeviceAngles = std::array<double, 6>;  // theta1..theta6 of the device [rad]

// Minimum-jerk motion (Flash and Hogan 1985), s^3 (10 - 15 s + 6 s^2) with s = t/T in [0, 1].
void add_minimum_jerk(const DeviceAngles& from, const DeviceAngles& to, double s, double T,
                      OperatorSample& sampled);

// `from` before the time `at`, then `to`; the rates are zero.
class StepMotion final : public OperatorMotion {
 public:
  StepMotion(const DeviceAngles& from, const DeviceAngles& to, double at, double duration)
      : from_(from), to_(to), at_(at), duration_(duration) {}
  OperatorSample sample(double t, double toward) const override;
  double duration() const override { return duration_; }
  std::string description() const override;

 private:
  DeviceAngles from_, to_;
  double at_, duration_;
};

// theta_j = middle_j + amplitude_j sin(phi), phi = 2 pi (f0 t + (f1 - f0) t^2 / (2 T)): frequency
// f0 to f1 [Hz] in T [s], linear in time. Starts with a velocity jump; at rest after T.
class ChirpMotion final : public OperatorMotion {
 public:
  ChirpMotion(const DeviceAngles& middle, const DeviceAngles& amplitude, double f0, double f1,
              double T)
      : middle_(middle), amplitude_(amplitude), f0_(f0), f1_(f1), duration_(T) {}
  OperatorSample sample(double t, double toward) const override;
  double duration() const override { return duration_; }
  std::string description() const override;

 private:
  DeviceAngles middle_, amplitude_;
  double f0_, f1_, duration_;
};

// Minimum-jerk motion from `at`, of duration T [s]; at rest before and after.
class ReachMotion final : public OperatorMotion {
 public:
  ReachMotion(const DeviceAngles& from, const DeviceAngles& to, double at, double T)
      : from_(from), to_(to), at_(at), T_(T) {}
  OperatorSample sample(double t, double /*toward*/) const override {
    OperatorSample sampled;
    add_minimum_jerk(from_, to_, std::clamp((t - at_) / T_, 0.0, 1.0), T_, sampled);
    return sampled;
  }
  double duration() const override { return at_ + T_; }
  std::string description() const override;

 private:
  DeviceAngles from_, to_;
  double at_, T_;
};

}  // namespace twinarm
