#include "coupling/target/operator_motion.h"

#include <cmath>
#include <numbers>

namespace twinarm {

OperatorSample AutomaticMotion::sample(double t, double toward) const {
  constexpr double pi = std::numbers::pi;
  const double s = t / sweep_time_;
  // The sweep of a step between t and toward; an end of a sweep is met within rounding.
  const double middle = 0.5 * (t + toward) / sweep_time_;
  const double nearest = std::round(s);
  const double inside = std::abs(s - nearest) < 1e-9 ? middle : s;
  // This order also handles NaN.
  const auto sweep = static_cast<int>(std::min(std::max(0.0, std::floor(inside)), sweeps_ - 1.0));
  const double direction = sweep % 2 == 0 ? 1.0 : -1.0;
  const double fraction = std::clamp(s - sweep, 0.0, 1.0);
  const double along = direction * (fraction - 0.5);  // -0.5 at the start, 0.5 at the end
  const bool moving = inside >= 0 && inside < sweeps_;
  const double rate = moving ? direction / sweep_time_ : 0.0;

  OperatorSample sampled;
  mapping_.set_robot_angle(sampled, 0, -pi * along, -pi * rate);
  mapping_.set_robot_angle(sampled, 1, pi / 2 * along, pi / 2 * rate);
  return sampled;
}

std::string AutomaticMotion::description() const {
  return "automatic: joint 1 from 90 to -90 deg, joint 2 from -45 to 45 deg, " +
         std::to_string(sweeps_) + " sweeps of " + short_number_text(sweep_time_) +
         " s, linear in time";
}

}  // namespace twinarm
