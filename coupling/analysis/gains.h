// Stability limits of a spring-damper for each stepping scheme, and conversions of gains.
//
// A scheme is an integrator with one term of coupling/analysis/step_matrix.h. Stable: spectral
// radius of the step matrix at most 1 (within 1e-9). O(n^3) for each step size that is tried.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace twinarm {

// With the stability condition of one degree of freedom, alpha = k h^2/I, beta = b h/I.
enum class SteppingScheme {
  euler,             // alpha < beta < 2 + alpha/2
  semi_implicit,     // alpha < 4 - 2 beta
  euler_difference,  // explicit Euler, velocity by backward difference: alpha < beta(1-beta)
  semi_implicit_difference,  // the difference equals the velocity: alpha < 4 - 2 beta
  semi_implicit_older,       // difference one frame older: alpha < 1 - beta
  hold,                      // exact motion under a held force: alpha < 2 beta, beta < 2
  hold_difference,           // with difference velocity: alpha < 2 beta (2-beta)/(2+beta)
  rk4,                       // |1 + l + l^2/2 + l^3/6 + l^4/24| < 1 for both l: l^2 + beta l +
                             // alpha = 0
  implicit_damper,           // semi-implicit, m* = h b: alpha < 4 + 2 beta
  implicit                   // m* = h b + h^2 k: always
};
inline constexpr auto all_schemes = [] {
  std::array<SteppingScheme, 10> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<SteppingScheme>(i);
  return all;
}();
const char* name_of(SteppingScheme scheme);

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// The largest h below which all are stable (max_stable()); 0 if none is (w h < 1e-4), kNoLimit if
// all are (to w h = 1e4). K and B symmetric; coordinates without stiffness and damping are ignored.
double max_stable_step(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K, const Eigen::MatrixXd& B,
                       SteppingScheme scheme);

// What is constant when the stiffness is scaled.
enum class HoldConstant {
  damping_per_stiffness,  // b/k: B proportional to K
  damping_ratio           // z: B proportional to the root of K
};
// Largest stable factor on all stiffnesses at this step; 0 and kNoLimit as above (to 1e8).
double max_stiffness_factor(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K,
                            const Eigen::MatrixXd& B, SteppingScheme scheme, double h,
                            HoldConstant keep);

// Largest stable w h of one degree of freedom with damping ratio zeta.
double max_omega_h(SteppingScheme scheme, double zeta);

// The largest stable x in [from, to]: a search in steps of 10 % (a narrower unstable window is
// missed), then bisection. Starts at a normal number: a denormal does not grow by 10 %.
template <class Stable>
double max_stable(Stable&& stable, double from, double to) {
  from = std::max(from, std::numeric_limits<double>::min());
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

// Equivalent gains. A spring-damper k, b on an apparent inertia I has w = sqrt(k/I), z = b/(2 I w).
// Linear: I [kg], k [N/m], b [N s/m]; torsional: [kg m^2, N m/rad, N m s/rad].
struct SpringGains {
  double k = 0, b = 0;
};
struct SpringResponse {
  double omega = 0, zeta = 0;  // [rad/s], 1
};
inline SpringGains gains_of(const SpringResponse& response, double inertia) {
  return {inertia * response.omega * response.omega, 2 * inertia * response.zeta * response.omega};
}
inline SpringResponse response_of(const SpringGains& gains, double inertia) {  // k > 0
  return {std::sqrt(gains.k / inertia), gains.b / (2 * std::sqrt(gains.k * inertia))};
}

// One link, small errors, spring at distance r from the axis: k_T = k_L r^2, b likewise. Not
// equivalent for a chain, where the matrices K_q and B_q must be equal
// (coupling/laws/equivalent_torsional_coupling.cpp).
inline SpringGains torsional_of_linear(const SpringGains& linear, double r) {
  return {linear.k * r * r, linear.b * r * r};
}

// Apparent inertia (operational-space inertia): of a joint coordinate 1/(M^-1)_jj; of a point or
// link orientation the principal values of (J M^-1 J^T)^-1, ascending, infinite in directions
// without motion.
double joint_inertia(const Eigen::MatrixXd& M, Eigen::Index velocity);
Eigen::Vector3d principal_inertias(const Eigen::MatrixXd& M, const Eigen::Matrix3Xd& J);

// MuJoCo's constraints (its documentation, "Computation", "Solver parameters"): reference
// acceleration -b_ref v - k_ref r, and motion  a + d (b_ref v + k_ref r) = (1 - d) a_0,  with the
// impedance d between solimp's dmin and dmax = d_max, and a_0 the unconstrained acceleration. So k
// = I d k_ref, b = I d b_ref, and loads act with the factor 1 - d.
struct MujocoImpedance {
  double d = 0.95, d_max = 0.95;  // d < dmax within solimp's width of zero error
};
// As in a model: (timeconst, dampratio), both positive, for
//   b_ref = 2/(d_max timeconst),  k_ref = d/(d_max^2 timeconst^2 dampratio^2),
// or (-stiffness, -damping), for  b_ref = damping/d_max,  k_ref = stiffness d/d_max^2.
struct Solref {
  double first = 0.02, second = 1;
  bool is_direct() const { return first <= 0 && second <= 0; }
};
SpringGains gains_of(const Solref& solref, double inertia, const MujocoImpedance& impedance = {});
// (timeconst, dampratio); k and b must be positive.
Solref solref_of(const SpringGains& gains, double inertia, const MujocoImpedance& impedance = {});
// (-stiffness, -damping).
Solref direct_solref_of(const SpringGains& gains, double inertia,
                        const MujocoImpedance& impedance = {});
// Static stiffness of such a constraint: k / (1 - d).
inline double mujoco_static_stiffness(double k, const MujocoImpedance& impedance = {}) {
  return k / (1 - impedance.d);
}
// MuJoCo's minimum of timeconst (refsafe).
inline double min_timeconst(double h) {
  return 2 * h;
}

// A drive of PhysX: stiffness and damping of a force, or of an acceleration (multiplied by the
// apparent inertia).
struct Drive {
  enum class Mode { force, acceleration };
  double stiffness = 0, damping = 0;
  Mode mode = Mode::force;
};
Drive drive_of(const SpringGains& gains, double inertia, Drive::Mode mode);
SpringGains gains_of(const Drive& drive, double inertia);

}  // namespace twinarm
