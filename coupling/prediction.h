// What theory says of a coupling before it is run (docs/coupling.md): natural frequencies, the
// largest stable step of each scheme, the error after a jump of the target's speed, the limit that
// the geometric stiffness of a point spring sets.
//
// About a pose, with e = q_K - q_D:  M e'' + B_q e' + K_q e = M q_K''.
#pragma once

#include <Eigen/Core>
#include <array>

#include "coupling/coupling.h"

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
  implicit_damper,           // semi-implicit, m* = h b: alpha < 4 + 2 beta
  implicit                   // m* = h b + h^2 k: always
};
inline constexpr std::array<Scheme, 9> all_schemes{Scheme::euler,
                                                   Scheme::semi_implicit,
                                                   Scheme::euler_difference,
                                                   Scheme::semi_implicit_difference,
                                                   Scheme::semi_implicit_older,
                                                   Scheme::hold,
                                                   Scheme::hold_difference,
                                                   Scheme::implicit_damper,
                                                   Scheme::implicit};
const char* name_of(Scheme scheme);
// The inequality above.
bool is_stable(Scheme scheme, double alpha, double beta);

// Eigenvalues of M^-1 K, ascending: squares of the natural frequencies [rad^2/s^2].
Eigen::VectorXd squared_frequencies(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K);

// Largest h for which the scheme is stable on M e'' + B e' + K e = 0, by the spectral radius of its
// step matrix; infinity where there is none. Searched in [1e-7, 10] s. Schemes without memory only
// (euler, semi_implicit and its difference, implicit_damper, implicit); throws std::logic_error
// else.
double largest_stable_step(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K,
                           const Eigen::MatrixXd& B, Scheme scheme);

// Largest |e_j| after the target's velocity jumps by V (e = 0, e' = V), per coordinate; linear
// theory about the pose, within the given time [s].
Eigen::VectorXd peak_after_jump(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K,
                                const Eigen::MatrixXd& B, const Eigen::VectorXd& V, double time);

// One degree of freedom: (V/w) exp(-z acos(z)/sqrt(1 - z^2)), V/(e w) at z = 1.
double peak_after_jump(double V, double omega, double zeta);

// A point spring at lever arm r, treated implicitly with step h on an inertia I about the joint, is
// stable only while its target's radius R_K stays below this [m]:
//   h^2 k r R_K < 4 I + 2 r^2 (h^2 k + h b).
double largest_target_radius(double I, double r, double k, double b, double h);

// The mass matrix at a pose.
Eigen::MatrixXd mass_matrix(const Model<double>& model, const State<double>& x);

}  // namespace twinarm
