// Curves that have the velocity and the acceleration of a motion at s = 0, for rates by
// differences.
#pragma once

#include <array>
#include <vector>

#include "solver/dynamics/dynamics.h"

namespace twinarm {

// q exp(shift) of every joint, also of those whose motion is given; shift = qd times a number.
template <class S>
void move(const Model<S>& model, const std::vector<S>& qd, const S& by, State<S>& x) {
  std::vector<S> shift(qd.size());
  for (std::size_t k = 0; k < qd.size(); ++k) shift[k] = by * qd[k];
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    S* q = x.q.data() + model.iq[i];
    if (model.joint[i] == JointType::prescribed) {
      const S* vJ = x.prescribed.data() + model.ip[i];
      const Vec3<S> v = transpose_times(quaternion_E(q + 3), Vec3<S>{vJ[3], vJ[4], vJ[5]});
      q[0] = q[0] + by * v.x, q[1] = q[1] + by * v.y, q[2] = q[2] + by * v.z;
      const std::array<S, 3> turn{by * vJ[0], by * vJ[1], by * vJ[2]};
      turn_quaternion(q + 3, turn.data(), q + 3);
    } else {
      visit_joint(model, i, [&](auto joint) { joint.integrate(q, shift.data() + model.iv[i], q); });
    }
  }
}

// Richardson: values at s, s/2, s/4 .. whose errors are a series in s^2.
template <std::size_t levels, class Value>
auto extrapolated(Value value) {
  std::array<decltype(value(0)), levels> at;
  for (std::size_t level = 0; level < levels; ++level) at[level] = value(level);
  double factor = 4;
  for (std::size_t last = levels; last-- > 1; factor *= 4)
    for (std::size_t k = 0; k < last; ++k) at[k] = at[k + 1] + (at[k + 1] - at[k]) / (factor - 1);
  return at[0];
}

}  // namespace twinarm
