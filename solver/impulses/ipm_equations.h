// Interior-point equations of interior_point.cpp and central_path.cpp: constraint laws as
// complementarity x o z = 0 of x, z in the second-order cone Q.
//
//   contact        x = (mu p_n, p_t),      z = (zeta, u_t);   frictionless: x = (p_n), z = (zeta)
//   friction disc  x = (radius p_n, p),    z = (zeta, u)
//   box            x = (half, p - middle), z = (zeta, u);     half and middle of [low, high]
//
// A contact and its discs share p_n, with the coupling condition
//   sum a zeta = u_n + sum a |w|,
// a the arm (mu, radius; 1 without friction) and w the tangential velocity (u_t, u) of each: the de
// Saxce condition for several cones. If p_n > 0, x o z = 0 gives zeta = |w|, hence u_n = 0; if
// p_n = 0, zeta >= |w| gives u_n >= 0. x_0 of a box is constant.
//
// Nesterov-Todd scaling: dx = d - W^2 dz. With W^2 = (A, A h^T; A h, .), eliminating dz_0 leaves
// S = eta^2 (1 - 2 w w^T / (2 w_0^2 - 1)); with l = a w / |w| and C = sum a^2 / A:
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
// Tangential rows: number and first index.
inline int tangential_rows(const ImpulseConstraint& c) {
  return c.law == ConstraintType::coulomb_cone ? 2
         : c.law == ConstraintType::unilateral ? 0
                                               : c.rows;
}
inline int first_tangential(const ImpulseConstraint& c) {
  return c.law == ConstraintType::coulomb_cone ? 1 : 0;
}

}  // namespace twinarm
