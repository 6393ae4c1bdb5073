// Run time against wall time: how far the run is to be, and how well it keeps up.
#pragma once

#include <algorithm>
#include <chrono>

#include "app/support/seconds.h"

namespace twinarm {

class Pace {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // From now on, at so many seconds of run time in one of wall time.
  void begin(Time wall, double run, double speed) {
    wall_ = measured_wall_ = wall;
    run_ = measured_run_ = run;
    speed_ = speed;
  }
  // Where the run is to be [s].
  double due(Time wall) const { return run_ + speed_ * as_seconds(wall - wall_); }
  // What is further behind than that is not made up for [s of wall time].
  void forgive(Time wall, double run, double most) {
    const double behind = due(wall) - run;
    if (behind > speed_ * most) run_ -= behind - speed_ * most;
  }
  // Run time over what was asked for, of the last second; 1: it keeps up.
  double factor(Time wall, double run) {
    const double passed = as_seconds(wall - measured_wall_);
    if (passed >= 1) {
      factor_ = (run - measured_run_) / (speed_ * passed);
      measured_wall_ = wall;
      measured_run_ = run;
    }
    return factor_;
  }

 private:
  Time wall_{}, measured_wall_{};
  double run_ = 0, measured_run_ = 0, speed_ = 1, factor_ = 1;
};

}  // namespace twinarm
