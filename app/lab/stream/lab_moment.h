// A lab's frame as what there is to be seen of it. The kinematic robot stands where the frame says
// that the hand had it; without a hand, where the scene's own targets have it at that time.
#pragma once

#include <memory>
#include <vector>

#include "app/lab/run/lab_frame.h"
#include "app/lab/stream/told_hand.h"
#include "app/simulate/simulate_input.h"

namespace twinarm {

class LabMoments {
 public:
  // The plan must outlive it, up to a change. Throws InputError: a trace that cannot be read.
  explicit LabMoments(const SimulatePlan& plan);
  void change(const SimulatePlan& plan);

  bool follows_device() const;  // whether the scene says so of any coupling
  Moment at_start();
  Moment of(const LabFrame& frame);
  std::vector<Pose> places(const LabFrame& frame) const;  // of bodies alone
  // As the last call of of() has left them, for this frame; null for a robot alone.
  SceneCouplings* couplings(const LabFrame& frame);

 private:
  void tell(const LabFrame& frame);

  const SimulatePlan* plan_ = nullptr;
  ToldHand hand_;
  std::unique_ptr<SceneCouplings> own_;  // as the scene says; a device is the told hand
  std::unique_ptr<SceneModel> in_hand_;  // the scene with a hand in place of its own motions
  std::unique_ptr<SceneCouplings> led_;  // of that one; null where own_ serves for both
};

}  // namespace twinarm
