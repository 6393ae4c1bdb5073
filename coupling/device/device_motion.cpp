#include "coupling/device/device_motion.h"

#include <algorithm>
#include <cmath>

namespace twinarm {

LiveHand::LiveHand(std::size_t remembered, const HandMapping& mapping)
    : mapping_(mapping), steps_(std::max<std::size_t>(1, remembered)) {}

void LiveHand::set(const HandTarget& target, double t, double h) noexcept {
  HandStep step{t, h, {}};
  for (std::size_t j = 0; j < std::min<std::size_t>(3, target.q.size()); ++j)
    mapping_.set_robot_angle(step.hand, j, target.q[j], target.qd[j]);
  step.hand.button = target.gripper_closed;
  set(step);
}

void LiveHand::set(const HandStep& step) noexcept {
  steps_[count_++ % steps_.size()] = step;
}

HandSample LiveHand::sample(double t, double toward) const {
  if (count_ == 0) return {};
  // The step that an instant just inside, seen from `toward`, belongs to: by halving, oldest first.
  double inside = t + 1e-9 * (toward - t);
  if (inside == t) inside = std::nextafter(t, toward);  // late in a run that is less than an ulp
  const std::size_t oldest = count_ - std::min(count_, steps_.size());
  std::size_t low = oldest, high = count_;
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (at(middle).t <= inside ? low : high) = middle;
  }
  const HandStep& step = at(low);
  HandSample hand = step.hand;
  const double since = std::clamp(t - step.t, 0.0, step.h);
  for (std::size_t j = 0; j < 6; ++j) hand.theta[j] += since * hand.theta_dot[j];
  const bool rests = inside < step.t || inside > step.t + step.h;
  if (rests) hand.theta_dot.fill(0);
  return hand;
}

std::vector<HandStep> LiveHand::steps() const {
  std::vector<HandStep> all;
  for (std::size_t n = count_ - std::min(count_, steps_.size()); n < count_; ++n)
    all.push_back(at(n));
  return all;
}

double LiveHand::duration() const {
  return count_ == 0 ? 0 : newest().t + newest().h;
}

}  // namespace twinarm
