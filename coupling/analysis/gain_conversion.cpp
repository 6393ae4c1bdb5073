#include "coupling/analysis/gain_conversion.h"

#include <cmath>
#include <limits>

#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {

SpringGains gains_of(const SpringResponse& response, double inertia) {
  return {inertia * response.omega * response.omega, 2 * inertia * response.zeta * response.omega};
}
SpringResponse response_of(const SpringGains& gains, double inertia) {
  return {std::sqrt(gains.k / inertia), gains.b / (2 * std::sqrt(gains.k * inertia))};
}

SpringGains torsional_of_linear(const SpringGains& linear, double r) {
  return {linear.k * r * r, linear.b * r * r};
}

double joint_inertia(const Eigen::MatrixXd& M, Eigen::Index velocity) {
  return 1 / inverse_of(M)(velocity, velocity);
}

Eigen::Vector3d principal_inertias(const Eigen::MatrixXd& M, const Eigen::Matrix3Xd& J) {
  constexpr double kImmovable = 1e-12;
  const Eigen::Matrix3d mobility = J * solve_symmetric(M, J.transpose());
  const Eigen::VectorXd values = symmetric_eigenvalues((mobility + mobility.transpose()) / 2);
  Eigen::Vector3d inertias;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double value = values[2 - i];
    inertias[i] =
        value > kImmovable * values[2] ? 1 / value : std::numeric_limits<double>::infinity();
  }
  return inertias;
}

// w^2 = d k_ref and 2 z w = d b_ref.
SpringGains gains_of(const Solref& solref, double inertia, const MujocoImpedance& impedance) {
  const double part = impedance.d / impedance.d_max;
  if (solref.is_direct())
    return {-inertia * solref.first * part * part, -inertia * solref.second * part};
  return gains_of(SpringResponse{part / (solref.first * solref.second), solref.second}, inertia);
}

Solref solref_of(const SpringGains& gains, double inertia, const MujocoImpedance& impedance) {
  const SpringResponse response = response_of(gains, inertia);
  return {impedance.d / (impedance.d_max * response.omega * response.zeta), response.zeta};
}

Solref direct_solref_of(const SpringGains& gains, double inertia,
                        const MujocoImpedance& impedance) {
  const double part = impedance.d / impedance.d_max;
  return {-gains.k / (inertia * part * part), -gains.b / (inertia * part)};
}

double mujoco_static_stiffness(double k, const MujocoImpedance& impedance) {
  return k / (1 - impedance.d);
}

Drive drive_of(const SpringGains& gains, double inertia, Drive::Mode mode) {
  const double by = mode == Drive::Mode::acceleration ? inertia : 1;
  return {gains.k / by, gains.b / by, mode};
}
SpringGains gains_of(const Drive& drive, double inertia) {
  const double by = drive.mode == Drive::Mode::acceleration ? inertia : 1;
  return {drive.stiffness * by, drive.damping * by};
}

}  // namespace twinarm
