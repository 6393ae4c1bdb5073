// Gains that mean the same: from a frequency and a damping ratio, from one coupling to another, and
// to and from the words of other engines.
//
// A spring-damper k, b on the inertia I that it feels swings with w = sqrt(k/I), z = b/(2 I w).
// Linear couplings: I is a mass [kg], k [N/m], b [N s/m]; torsional: [kg m^2, N m/rad, N m s/rad].
#pragma once

#include <Eigen/Core>

namespace twinarm {

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
inline double shortest_timeconst(double h) {
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
