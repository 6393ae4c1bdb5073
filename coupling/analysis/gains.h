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
enum class SteppingScheme {
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
inline constexpr std::array<SteppingScheme, 10> all_schemes{
    SteppingScheme::euler,
    SteppingScheme::semi_implicit,
    SteppingScheme::euler_difference,
    SteppingScheme::semi_implicit_difference,
    SteppingScheme::semi_implicit_older,
    SteppingScheme::hold,
    SteppingScheme::hold_difference,
    SteppingScheme::rk4,
    SteppingScheme::implicit_damper,
    SteppingScheme::implicit};
const char* name_of(SteppingScheme scheme);

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// The largest h of which every smaller one is stable as well; 0 where none is (w h < 1e-4),
// kNoLimit where all are (to w h = 1e4). K and B symmetric; coordinates that neither holds do not
// count.
double max_stable_step(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K, const Eigen::MatrixXd& B,
                       SteppingScheme scheme);

// What stays as it is when the stiffness grows.
enum class HoldConstant {
  damping_per_stiffness,  // b/k: B grows as K
  damping_ratio           // z: B grows as the root of K
};
// How many times stiffer all springs may be at this step; 0 and kNoLimit as above (to 1e8 times).
double max_stiffness_factor(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K,
                            const Eigen::MatrixXd& B, SteppingScheme scheme, double h,
                            HoldConstant keep);

// On one degree of freedom: the largest w h at a damping ratio.
double max_omega_h(SteppingScheme scheme, double zeta);

// The largest x in [from, to] that is stable, with all below it as far as steps of a tenth show: a
// narrower window of instability is passed over.
template <class Stable>
double max_stable(Stable&& stable, double from, double to) {
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

// Gains that mean the same: from a frequency and a damping ratio, from one coupling to another, and
// to and from the words of other engines.
//
// A spring-damper k, b on the inertia I that it feels swings with w = sqrt(k/I), z = b/(2 I w).
// Linear couplings: I is a mass [kg], k [N/m], b [N s/m]; torsional: [kg m^2, N m/rad, N m s/rad].
struct SpringGains {
  double k = 0, b = 0;
};
struct SpringResponse {
  double omega = 0, zeta = 0;  // [rad/s], 1
};
SpringGains gains_of(const SpringResponse& response, double inertia);
SpringResponse response_of(const SpringGains& gains, double inertia);  // k > 0

// One link, small errors, the spring's point at distance r from the axis: k_T = k_L r^2 and b
// likewise. For a chain this is no match: the outer spring holds the inner joint too. There the
// full matrices K_q and B_q must be the same (coupling/laws/equivalent_torsional_coupling.cpp).
SpringGains torsional_of_linear(const SpringGains& linear, double r);

// What a single spring feels, all else free to move (the operational-space inertia): of a joint's
// coordinate 1/(M^-1)_jj; of a point or a link's orientation the principal values of
// (J M^-1 J^T)^-1, ascending, infinite in directions in which it cannot move. The smallest is that
// of the highest frequency.
double joint_inertia(const Eigen::MatrixXd& M, Eigen::Index velocity);
Eigen::Vector3d principal_inertias(const Eigen::MatrixXd& M, const Eigen::Matrix3Xd& J);

// MuJoCo's constraints (its chapter Computation, solver parameters): the reference acceleration is
// -b_ref v - k_ref r, and the constraint moves as  a + d (b_ref v + k_ref r) = (1 - d) a_0, with
// the impedance d between solimp's dmin and dmax = d_max, and a_0 the acceleration without it. So
// k = I d k_ref, b = I d b_ref, and a load is felt only by its part 1 - d.
struct MujocoImpedance {
  double d = 0.95, d_max = 0.95;  // MuJoCo's dmax; d is less within solimp's width of zero error
};
// As written in a model: (timeconst, dampratio), both positive, for
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
// Against a steady load such a constraint is stiffer than it swings: k / (1 - d).
double mujoco_static_stiffness(double k, const MujocoImpedance& impedance = {});
// MuJoCo's own floor of timeconst (refsafe): shorter ones are taken as this.
inline double min_timeconst(double h) {
  return 2 * h;
}

// A drive as PhysX has it: stiffness and damping of a force, or of an acceleration, which the
// engine multiplies by the inertia that it feels.
struct Drive {
  enum class Mode { force, acceleration };
  double stiffness = 0, damping = 0;
  Mode mode = Mode::force;
};
Drive drive_of(const SpringGains& gains, double inertia, Drive::Mode mode);
SpringGains gains_of(const Drive& drive, double inertia);

}  // namespace twinarm
