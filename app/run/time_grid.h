// The times of a run of fixed steps.
#pragma once

#include <cmath>
#include <limits>

namespace twinarm {

// Two times within this part of a step are the same one.
inline constexpr double kSameTime = 1e-9;

// t = n step, the last one `duration`, which may be infinite; both [s].
class TimeGrid {
 public:
  TimeGrid(double step, double duration) : step_(step), duration_(duration) {
    if (std::isinf(duration_)) return;
    const double whole = std::floor(duration_ / step_ + kSameTime);
    steps_ = static_cast<long>(whole);
    if (duration_ - whole * step_ > kSameTime * step_) ++steps_;
  }
  long steps() const { return steps_; }
  double time(long n) const { return n >= steps_ ? duration_ : static_cast<double>(n) * step_; }
  // Whether a run that stands at t after n steps stands on the grid.
  bool holds(long n, double t) const { return std::abs(t - time(n)) <= kSameTime * step_; }
  // Of the step from t, which need not lie on the grid: the last one is shorter where the duration
  // is no multiple of the step.
  double length(double t) const {
    const double rest = duration_ - t;
    return rest < step_ * (1 - kSameTime) ? rest : step_;
  }

 private:
  double step_, duration_;
  long steps_ = std::numeric_limits<long>::max();
};

}  // namespace twinarm
