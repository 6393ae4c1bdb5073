// The laws of impulse_problem.h as maps from velocities to impulses, for Newton's method.
//
// For a set K of impulses (a half-line, an interval, a disc, Coulomb's cone) the law says
//   p = P_K(p - rho ut)   for any rho > 0,    ut = u + (mu |u_t|, 0, 0) for the cone, u otherwise:
// P_K is the projection, and mu |u_t| makes the law Coulomb's own (de Saxce and Feng 1998): without
// it a sliding contact would lift. With the multiplier l and the shift s = mu |u_t| of the round
// before, the response is
//   p(u) = P_K(l - rho (u + s e_n)),       -dp/du = rho P_K'   (symmetric, not negative),
// the gradient of a convex function of u; at a fixed point in l and s, p obeys the law.
#pragma once

#include <array>

#include "solver/impulses/impulse_problem.h"
#include "solver/linear_algebra/nan_max.h"

namespace twinarm {

// What the rounds before have left for one constraint.
struct MultiplierState {
  double rho = 0;             // [kg], or [kg m^2]
  std::array<double, 3> l{};  // multiplier [N s]
  double shift = 0;           // s of a cone, where it is held [m/s]
  double radius = 0;          // of a disc, or of a compliant contact's friction [N s]
};

using Vec = std::array<double, 3>;
using Mat = std::array<double, 9>;  // row by row

// p(u), u with b, and D = -dp/du. Shift held: the gradient of a convex function, D symmetric.
// Followed: s = mu |u_t| at this u, and in D.
enum class DeSaxceShift { frozen, differentiated };
void respond(const ImpulseConstraint& c, const MultiplierState& memory, DeSaxceShift shift,
             const Vec& u, Vec& p, Mat& D);
// Shift held: p(u) alone.
Vec answer(const ImpulseConstraint& c, const MultiplierState& memory, const Vec& u);

// Where p(u) of a disc is at its edge, the direction of p there; 0 within.
Vec sliding_direction(const ImpulseConstraint& c, const MultiplierState& memory, const Vec& u);

// How far p is from obeying the law at u, with the same for rho = 1/g: |p - P_K(p - rho ut)| / rho
// [m/s]; of a compliant contact p less what its springs and bristles give, over rho and stiffness.
double law_residual(const ImpulseConstraint& c, const MultiplierState& memory, double rho,
                    const Vec& u, const Vec& p);

// mu |u_t| of a cone, 0 of others.
double shift_of(const ImpulseConstraint& c, const Vec& u);

// Sets l and the bounds to those of p and u.
void remember(const ImpulseConstraint& c, const std::vector<ImpulseConstraint>& all, const Vec& u,
              const Vec& p, MultiplierState& memory);

}  // namespace twinarm
