// The times of a run of fixed steps.
#pragma once

#include <cmath>

namespace twinarm {

// Two times within this part of a step are the same one.
inline constexpr double kSameTime = 1e-9;

// t = n step, the last one `duration`; both [s].
class TimeGrid {
 public:
  TimeGrid(double step, double duration) : step_(step), duration_(duration) {
    const double whole = std::floor(duration_ / step_ + kSameTime);
    steps_ = static_cast<long>(whole);
    if (duration_ - whole * step_ > kSameTime * step_) ++steps_;
  }
  long steps() const { return steps_; }
  double time(long n) const { return n >= steps_ ? duration_ : static_cast<double>(n) * step_; }
  // The last one is shorter where the duration is no multiple of the step.
  double length(long n) const {
    const double rest = duration_ - time(n);
    return rest < step_ * (1 - kSameTime) ? rest : step_;
  }

 private:
  double step_, duration_;
  long steps_ = 0;
};

}  // namespace twinarm
