// What impulse_interior.cpp and impulse_path.cpp share: contacts as points of the cone Q, scaled by
// T = diag(1/mu, 1, 1):  z = T (u + mu |u_t| e_n),  p = T x.
#pragma once

#include "solver/impulse_law.h"

namespace twinarm {

inline bool is_cone(const ImpulseConstraint& c) {
  return c.law == ImpulseLaw::at_least || c.law == ImpulseLaw::coulomb;
}
inline double inverse_mu(const ImpulseConstraint& c) {
  return c.law == ImpulseLaw::coulomb ? 1 / c.mu : 1;
}
inline Vec scaled(const ImpulseConstraint& c, const Vec& a) {  // T a
  return {inverse_mu(c) * a[0], a[1], a[2]};
}

}  // namespace twinarm
