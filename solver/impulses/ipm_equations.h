// What interior_point.cpp and central_path.cpp share: laws as pairs x, z of the cone Q that obey
// x o z = 0.
//
//   contact           x = (mu p_n, p_t),          z = (zeta, u_t);     without friction (p_n),
//   (zeta) disc              x = (radius p_n, p),        z = (zeta, u) within            x = (half,
//   p - middle),     z = (zeta, u);       half and middle of [low, high]
//
// A contact and its discs share p_n, and what goes with it is
//   sum a zeta = u_n + sum a |w|,
// a the arm (mu, radius; 1 without friction) and w the velocity across (u_t, u) of each: de Saxce's
// law for several cones. For where p_n > 0, each x o z = 0 makes zeta = |w|, and so u_n = 0; where
// p_n = 0, zeta >= |w| leaves u_n >= 0. What is `within` has an x_0 that stays.
//
// In Nesterov and Todd's scaling, dx = d - W^2 dz. With W^2 = (A, A h^T; A h, .), which leaves
// S = eta^2 (1 - 2 w w^T / (2 w_0^2 - 1)) once dz_0 is eliminated, l = a w / |w|, C = sum a^2 / A:
//   dp_n = n - (du_n + sum (l + a h) . dw) / C,       n = (sum a d_0 / A - a h . r - r_n) / C,
//   dx_t = d_t - h (d_0 - a dp_n) - S (dw + r),       dz_0 = (d_0 - a dp_n) / A - h . (dw + r).
#pragma once

#include "solver/impulses/impulse_law.h"

namespace twinarm {

inline double arm_of(const ImpulseConstraint& c) {
  return c.law == ConstraintType::coulomb_cone    ? c.mu
         : c.law == ConstraintType::unilateral    ? 1
         : c.law == ConstraintType::friction_disc ? c.radius
                                                  : 0;
}
// The rows across: how many, and the first.
inline int across(const ImpulseConstraint& c) {
  return c.law == ConstraintType::coulomb_cone ? 2
         : c.law == ConstraintType::unilateral ? 0
                                               : c.rows;
}
inline int first_across(const ImpulseConstraint& c) {
  return c.law == ConstraintType::coulomb_cone ? 1 : 0;
}
inline bool is_contact(const ImpulseConstraint& c) {
  return c.law == ConstraintType::unilateral || c.law == ConstraintType::coulomb_cone;
}

}  // namespace twinarm
