#include "coupling/target/scripted_motion.h"

#include <cmath>
#include <numbers>

namespace twinarm {
namespace {

// Whether a step from t towards `toward` is after the event, which may be met within rounding.
bool is_after(double t, double toward, double event) {
  return std::abs(t - event) < 1e-9 ? 0.5 * (t + toward) > event : t > event;
}

}  // namespace

OperatorSample StepMotion::sample(double t, double toward) const {
  OperatorSample sampled;
  sampled.theta = is_after(t, toward, at_) ? to_ : from_;
  return sampled;
}

std::string StepMotion::description() const {
  return "scripted: a step after " + short_number_text(at_) + " s";
}

OperatorSample ChirpMotion::sample(double t, double toward) const {
  const double s = std::clamp(t, 0.0, duration_), slope = (f1_ - f0_) / duration_;
  const double phi = 2 * std::numbers::pi * (f0_ + 0.5 * slope * s) * s;
  const bool moves = is_after(t, toward, 0) && !is_after(t, toward, duration_);
  const double omega = moves ? 2 * std::numbers::pi * (f0_ + slope * s) : 0.0;
  OperatorSample sampled;
  for (std::size_t j = 0; j < 6; ++j) {
    sampled.theta[j] = middle_[j] + amplitude_[j] * std::sin(phi);
    sampled.theta_dot[j] = amplitude_[j] * omega * std::cos(phi);
  }
  return sampled;
}

std::string ChirpMotion::description() const {
  return "scripted: a chirp from " + short_number_text(f0_) + " to " + short_number_text(f1_) +
         " Hz in " + short_number_text(duration_) + " s";
}

void add_minimum_jerk(const DeviceAngles& from, const DeviceAngles& to, double s, double T,
                      OperatorSample& sampled) {
  for (std::size_t j = 0; j < 6; ++j) {
    const double D = to[j] - from[j];
    sampled.theta[j] = from[j] + D * s * s * s * (10 - 15 * s + 6 * s * s);
    sampled.theta_dot[j] = D / T * 30 * s * s * (1 - s) * (1 - s);
  }
}

std::string ReachMotion::description() const {
  return "scripted: a minimum-jerk reach of " + short_number_text(T_) + " s after " +
         short_number_text(at_) + " s";
}

}  // namespace twinarm
