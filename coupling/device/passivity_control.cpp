#include "coupling/device/passivity_control.h"

#include <algorithm>

namespace twinarm {
namespace {

constexpr double kLeastPart = 1e-9;  // part of the peak: in 10^9 ticks one tick's work

}  // namespace

void PassivityControl::moved_to(const Vector3& x) noexcept {
  if (placed_ && x != x_) {
    d_ = x - x_;
    E_ -= held_.dot(d_);
    lowest_ = std::min(lowest_, E_);
  }
  x_ = x;
  placed_ = true;
}

Vector3 PassivityControl::damped(const Vector3& wanted) const noexcept {
  const double way = d_.squaredNorm();
  if (!(way > 0)) return wanted;
  const double along = wanted.dot(d_);
  if (E_ < 0) return -std::min(-2 * E_ / way, stiffest_) * d_;
  return along > E_ ? Vector3(wanted - (along - E_) / way * d_) : wanted;
}

double PassivityControl::allowance() const noexcept {
  // Not quite none at the lowest: from nothing there is no way back.
  return most_ > 0 ? std::clamp(kLeastPart + (E_ - lowest_) / most_, kLeastPart, 1.0) : 1.0;
}

Vector3 PassivityControl::tick(const Vector3& x, const Vector3& wanted, double peak) noexcept {
  moved_to(x);
  Vector3 force = damped(wanted);
  const double most = peak * allowance(), size = force.norm();
  if (size > most) force *= most / size;
  holds(force);
  return force;
}

}  // namespace twinarm
