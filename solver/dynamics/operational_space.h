// Operational-space inertia, RBDA section 8.4 and Khatib (1987).
#pragma once

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/world_kinematics.h"
#include "solver/model/joint_algebra.h"

namespace twinarm {

// J M^-1 J^T of a body's point, 6 x 6, world axes, (angular; linear): maps a wrench at the point to
// the acceleration of the point. Its inverse, if it exists, is the operational-space inertia
// Lambda. Six products with M^-1, each O(n); requires kinematics() and aba() at the same q.
// `at_rest` (one per velocity) and `wrench` (one per body) are scratch: all zero before and after.
template <class S>
MatN<S, 6> inverse_operational_inertia(const Model<S>& model, std::size_t body, const Vec3<S>& r_B,
                                       const std::vector<S>& at_rest, std::vector<Force<S>>& wrench,
                                       Workspace<S>& w) {
  MatN<S, 6> inverse;
  const Mat3<S>& E = w.X0[body].E;
  for (std::size_t k = 0; k < 6; ++k) {
    const VecN<S, 6> e = unit_vector<S, 6>(k);
    const Vec3<S> n = E * Vec3<S>{e[0], e[1], e[2]}, f = E * Vec3<S>{e[3], e[4], e[5]};
    wrench[body] = {plus_cross(n, r_B, f), f};
    minv_times(model, at_rest, wrench, w);
    const Motion<S>& a = w.dv[body];
    const Vec3<S> angular = to_world(w, body, a.w),
                  linear = to_world(w, body, plus_cross(a.v, a.w, r_B));
    const VecN<S, 6> column{angular.x, angular.y, angular.z, linear.x, linear.y, linear.z};
    for (std::size_t row = 0; row < 6; ++row) inverse[row][k] = column[row];
  }
  wrench[body] = {};
  return inverse;
}

}  // namespace twinarm
