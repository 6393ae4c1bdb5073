// Restitution of a Hunt-Crossley contact of exponent 1 without other forces, m dv/dt = -N with
// N = k d (1 + c d'): dividing by v = d' gives that c v - ln(1 + c v) is the same before and after.
#pragma once

#include <cmath>

namespace twinarm::testing {

// Restitution e of  c v - ln(1 + c v) = -c e v - ln(1 - c e v), for cv = c v > 0; by bisection.
inline double hunt_crossley_restitution(double cv) {
  const double before = cv - std::log1p(cv);
  double low = 0, high = std::fmin(1.0, 1 / cv);
  for (double e = 0.5 * (low + high); low < e && e < high; e = 0.5 * (low + high))
    (-cv * e - std::log1p(-cv * e) < before ? low : high) = e;
  return low;
}

}  // namespace twinarm::testing
