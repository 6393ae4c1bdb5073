// The paper's automatic motion (section Experiments): robot joint 1 from 90 to -90 degrees and
// joint 2 from -45 to 45 degrees, at once, linearly in time; back; and the first sweep again. The
// speed jumps at every end. Expressed as device angles, so that it takes the same way as a hand.
#pragma once

#include "coupling/target/operator_motion.h"

namespace twinarm {

class AutomaticMotion final : public HandSource {
 public:
  // sweep_time [s] of one sweep, 1 s in the paper.
  AutomaticMotion(const HandMapping& mapping, double sweep_time = 1.0, int sweeps = 3);
  HandSample sample(double t, double toward) const override;
  double duration() const override { return sweep_time_ * sweeps_; }
  std::string description() const override;

 private:
  HandMapping mapping_;
  double sweep_time_;
  int sweeps_;
};

}  // namespace twinarm
