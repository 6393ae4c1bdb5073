// F2, F3: two links with vertical hinges: gravity does no work. With h = m2 l1 c2 sin q2,
//   M11 = I1 + m1 c1^2 + I2 + m2 (l1^2 + c2^2 + 2 l1 c2 cos q2),
//   M12 = I2 + m2 (c2^2 + l1 c2 cos q2),   M22 = I2 + m2 c2^2,
//   C1 = -h (2 qd1 qd2 + qd2^2),           C2 = h qd1^2,           G = 0.
// Angles from x and between the links; c from the joint to the centre of mass, I about it.
#pragma once

#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {

struct PlanarArm {
  double m1 = 5, m2 = 3;        // [kg]
  double l1 = 0.4, c1 = 0.2;    // [m]
  double c2 = 0.15;             // [m]
  double I1 = 0.07, I2 = 0.02;  // [kg m^2]
};
inline PlanarArm uniform_arm() {  // slender links of 0.4 and 0.3 m
  return {.I1 = 5 * 0.4 * 0.4 / 12, .I2 = 3 * 0.3 * 0.3 / 12};
}
Model<double> model_of(const PlanarArm& arm);

struct PlanarArmTerms {
  Real M11, M12, M22, C1, C2;
};
PlanarArmTerms terms_of(const PlanarArm& arm, Real q2, Real qd1, Real qd2);
inline special::Two accelerations_of(const PlanarArmTerms& terms, special::Two torques) {
  return special::solve_two(terms.M11, terms.M12, terms.M22,
                            {torques.first - terms.C1, torques.second - terms.C2});
}

}  // namespace twinarm
