#include "coupling/device/passivity.h"

#include <algorithm>

namespace twinarm {

void PassivityControl::moved_to(const Vector3& x) noexcept {
  if (placed_ && x != x_) {
    d_ = x - x_;
    E_ -= held_.dot(d_);
  }
  x_ = x;
  placed_ = true;
}

Vector3 PassivityControl::damped(const Vector3& wanted) const noexcept {
  const double way = d_.squaredNorm();
  const double lack = wanted.dot(d_) - (E_ < 0 ? 2 * E_ : E_);
  if (!(way > 0) || !(lack > 0)) return wanted;
  return wanted - lack / way * d_;
}

double PassivityControl::allowance() const noexcept {
  return most_ > 0 ? std::clamp(1 + E_ / most_, 0.0, 1.0) : 1.0;
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
