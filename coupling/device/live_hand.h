// A hand that is known only up to now: the newest target of a device, as a HandSource.
//
// A step [t, t + h] needs the KVR at its end, which nobody knows yet: x_K' = x_K + h v_K of the
// newest target. Nothing is invented beyond one step: a target that is not renewed stands still.
#pragma once

#include "coupling/device/device_mapping.h"
#include "coupling/hand.h"
#include "coupling/hand_mapping.h"

namespace twinarm {

class LiveHand final : public HandSource {
 public:
  explicit LiveHand(const HandMapping& mapping) : mapping_(mapping) {}
  // The target of the step that begins at t and takes h.
  void set(const HandTarget& target, double t, double h) noexcept;
  HandSample sample(double t, double toward) const override;
  double duration() const override;  // without end
  std::string description() const override { return "a hand device, live"; }

 private:
  HandMapping mapping_;
  HandSample newest_;
  double t_ = 0, h_ = 0;
};

}  // namespace twinarm
