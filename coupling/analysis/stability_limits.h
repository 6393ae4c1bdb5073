// The largest stable step, or stiffness, of a spring-damper under each way to step it.
//
// A scheme is an integrator and one part of coupling/analysis/step_matrix.h. Stable: the spectral
// radius of the step matrix is at most 1 (to 1e-9). All in O(n^3) for each step that is tried.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>

namespace twinarm {

// How a spring-damper is stepped. One degree of freedom, alpha = k h^2/I, beta = b h/I; stable iff
enum class Scheme {
  euler,             // alpha < beta < 2 + alpha/2
  semi_implicit,     // alpha < 4 - 2 beta
  euler_difference,  // explicit Euler, velocity by backward difference: alpha < beta(1-beta)
  semi_implicit_difference,  // the difference IS the velocity: alpha < 4 - 2 beta
  semi_implicit_older,       // difference one frame older: alpha < 1 - beta
  hold,                      // exact motion under a force held for h: alpha < 2 beta, beta < 2
  hold_difference,           // the same, difference velocity: alpha < 2 beta (2-beta)/(2+beta)
  rk4,                       // |1 + l + l^2/2 + l^3/6 + l^4/24| < 1 for both l: l^2 + beta l +
                             // alpha = 0
  implicit_damper,           // semi-implicit, m* = h b: alpha < 4 + 2 beta
  implicit                   // m* = h b + h^2 k: always
};
inline constexpr std::array<Scheme, 10> all_schemes{Scheme::euler,
                                                    Scheme::semi_implicit,
                                                    Scheme::euler_difference,
                                                    Scheme::semi_implicit_difference,
                                                    Scheme::semi_implicit_older,
                                                    Scheme::hold,
                                                    Scheme::hold_difference,
                                                    Scheme::rk4,
                                                    Scheme::implicit_damper,
                                                    Scheme::implicit};
const char* name_of(Scheme scheme);

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// The largest h of which every smaller one is stable as well; 0 where none is (w h < 1e-4),
// kNoLimit where all are (to w h = 1e4). K and B symmetric; coordinates that neither holds do not
// count.
double largest_stable_step(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K,
                           const Eigen::MatrixXd& B, Scheme scheme);

// What stays as it is when the stiffness grows.
enum class Keep {
  damping_per_stiffness,  // b/k: B grows as K
  damping_ratio           // z: B grows as the root of K
};
// How many times stiffer all springs may be at this step; 0 and kNoLimit as above (to 1e8 times).
double largest_stiffness_factor(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K,
                                const Eigen::MatrixXd& B, Scheme scheme, double h, Keep keep);

// On one degree of freedom: the largest w h at a damping ratio.
double largest_omega_h(Scheme scheme, double zeta);

// The largest x in [from, to] that is stable, with all below it as far as steps of a tenth show: a
// narrower window of instability is passed over.
template <class Stable>
double largest_stable(Stable&& stable, double from, double to) {
  if (!stable(from)) return 0;
  double inside = from;
  while (inside < to && stable(1.1 * inside)) inside *= 1.1;
  if (inside >= to) return kNoLimit;
  double outside = 1.1 * inside;
  while (outside - inside > 1e-10 * inside) {
    const double middle = 0.5 * (inside + outside);
    (stable(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace twinarm
