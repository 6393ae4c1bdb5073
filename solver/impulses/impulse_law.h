// Constraint laws of impulse_problem.h as projections, for the semismooth Newton method.
//
// For a convex set K of impulses (half-line, interval, disc, friction cone) the law is
//   p = P_K(p - rho ut)   for any rho > 0,   ut = u + (mu |u_t|, 0, 0) for the cone, else u.
// P_K is the projection on K, mu |u_t| the de Saxce shift (de Saxce and Feng 1998), which makes the
// law exact Coulomb friction; without it sliding contacts would separate. With multiplier l and
// shift s of the last augmented-Lagrangian iteration,
//   p(u) = P_K(l - rho (u + s e_n)),       -dp/du = rho P_K'   (symmetric positive semidefinite),
// the gradient of a convex function of u. At a fixed point in l and s, p satisfies the law.
#pragma once

#include "solver/impulses/impulse_problem.h"
#include "solver/linear_algebra/nan_max.h"

namespace twinarm {

// Augmented-Lagrangian state of one constraint.
struct MultiplierState {
  double rho = 0;             // penalty [kg, kg m^2]
  std::array<double, 3> l{};  // multiplier [N s]
  double shift = 0;           // de Saxce shift s, if frozen [m/s]
  double radius = 0;          // friction bound of a disc or of a compliant contact [N s]
};

using Vec = std::array<double, 3>;
using Mat = std::array<double, 9>;  // row-major

// p(u), u including b, and D = -dp/du. Frozen shift: gradient of a convex function, D symmetric.
// Differentiated: s = mu |u_t| at this u, with its derivative in D.
enum class DeSaxceShift { frozen, differentiated };
void project_impulse(const ImpulseConstraint& c, const MultiplierState& state, DeSaxceShift shift,
                     const Vec& u, Vec& p, Mat& D);
// Frozen shift: p(u) only.
Vec project_impulse(const ImpulseConstraint& c, const MultiplierState& state, const Vec& u);

// Direction of p(u) of a disc if it is on the boundary; 0 in the interior.
Vec sliding_direction(const ImpulseConstraint& c, const MultiplierState& state, const Vec& u);

// Residual of the law at u: |p - P_K(p - rho ut)| / rho [m/s]. Compliant contact: difference of p
// to the force law, over rho plus stiffness.
double law_residual(const ImpulseConstraint& c, const MultiplierState& state, double rho,
                    const Vec& u, const Vec& p);

inline bool is_contact(const ImpulseConstraint& c) {
  return c.law == ConstraintType::unilateral || c.law == ConstraintType::coulomb_cone;
}

// mu |u_t| of a cone, else 0.
double de_saxce_shift(const ImpulseConstraint& c, const Vec& u);

// Multiplier update: l = p, shift and friction bound from p and u.
void update_multiplier(const ImpulseConstraint& c, const std::vector<ImpulseConstraint>& all,
                       const Vec& u, const Vec& p, MultiplierState& state);

}  // namespace twinarm
