// A hand that stands where it is told: what a frame says of the run's hand.
#pragma once

#include <string>
#include <vector>

#include "coupling/device/live_hand.h"

namespace twinarm {

class ToldHand final : public HandSource {
 public:
  void tell(const std::vector<double>& q_K, bool gripper_closed) {
    LiveHand told(1);
    told.set({q_K, std::vector<double>(q_K.size(), 0.0), gripper_closed}, 0, 1);
    hand_ = told;
  }
  HandSample sample(double t, double toward) const override { return hand_.sample(t, toward); }
  double duration() const override { return hand_.duration(); }
  std::string description() const override { return "the hand of a frame"; }

 private:
  LiveHand hand_{1};
};

}  // namespace twinarm
