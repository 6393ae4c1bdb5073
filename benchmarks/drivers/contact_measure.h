// How well a scene with contacts is held over a run, by one and the same measure for all engines:
// our collision detection at the coordinates that they report.
#pragma once

#include <memory>
#include <vector>

#include "benchmarks/scenes/mechanisms.h"

namespace twinarm::bench {

class ContactMeasure {
 public:
  explicit ContactMeasure(const TimedScene& timed);
  ~ContactMeasure();
  void take(int step, const std::vector<double>& q);  // after each step, as in Scene

  double penetration() const { return penetration_; }  // the deepest point, of the last step [m]
  double largest_penetration() const { return largest_; }
  // Boxes: the farthest that one of them is from its vertical at the start [m]. The ball: how far
  // it creeps in the last fifth of the run [m].
  double drift() const { return drift_; }

 private:
  struct Detection;
  TimedScene timed_;
  std::unique_ptr<Detection> detection_;
  std::array<double, 3> reference_{};
  double penetration_ = 0, largest_ = 0, drift_ = 0;
};

}  // namespace twinarm::bench
