// Joint-space stiffness and damping of couplings, their modes, static deflection, and the limit of
// implicit point springs.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>

#include "coupling/laws/coupling.h"
#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/kinematics.h"
#include "solver/model/workspace.h"

namespace twinarm {

// Static deflection K_q^-1 G [rad, m] under the joint forces G, small angles; NaN for coordinates
// without stiffness.
Eigen::VectorXd chain_sag(const Eigen::MatrixXd& K, const Eigen::VectorXd& G);

// Two springs in series: a wall k_e behind a coupling k_c (Colgate, Stanley and Brown 1995). Either
// may be infinite.
double series_stiffness(double k_c, double k_e);

// Maximum radius R_K of the target for stability of an implicit point spring at lever arm r with
// step h on an inertia I about the joint [m] (docs/understand/stability_of_spring_dampers.md):
//   h^2 k r R_K < 4 I + 2 r^2 (h^2 k + h b).
double max_target_radius(double I, double r, double k, double b, double h);

// That limit for every joint between the base and the spring's link; radii from the joint's axis.
// Linear theory of one joint with the others locked: for a chain an estimate.
struct TargetRadius {
  int body = 0;           // of the joint; 0: no revolute joint
  double r = 0, R_K = 0;  // [m]
  double largest = 0;     // maximum R_K [m]
  double ratio() const { return body > 0 ? R_K / largest : 0; }  // above 1: unstable
};

// The joint with the largest ratio. D: DVR, K: KVR. O(n^2); allocates.
TargetRadius nearest_target_radius(const Model<double>& model, const State<double>& x,
                                   const Kinematics& D, const Kinematics& K, const Spring& spring,
                                   double h);

// Adds all applied forces at a state; must be smooth there.
using AppliedForces = std::function<void(const State<double>&, const Kinematics&, Forces<double>&)>;

// Applied forces near a state, for differences. The arguments must outlive it.
class NearbyForces {
 public:
  NearbyForces(const Model<double>& model, const State<double>& x, const AppliedForces& applied)
      : model_(model), x_(x), applied_(applied), moved_(x), k_(model) {}
  // After a move by s along a coordinate's tangent, or of the velocity itself.
  Forces<double> at(std::size_t dof, bool of_velocity, double s);
  const State<double>& state() const { return moved_; }  // of the last call

 private:
  const Model<double>& model_;
  const State<double>& x_;
  const AppliedForces& applied_;
  State<double> moved_;
  Kinematics k_;
};

// Springs at points p with forces F_p: tau = sum_p J_p^T F_p, so
//   K = -d tau/dq = sum_p J_p^T k_p J_p - sum_p (dJ_p^T/dq) F_p.
// The first sum is K at zero error (Coupling::joint_space), the second the geometric stiffness. dq
// are tangent increments, along the first `count` velocities; the other columns are 0. By central
// differences, extrapolated twice: relative error about 1e-9. O(n) per velocity.
Eigen::MatrixXd tangent_stiffness(const Model<double>& model, const State<double>& x,
                                  const AppliedForces& applied, std::size_t count);

// Eigenvalues of M^-1 K, ascending: squares of the natural frequencies [rad^2/s^2].
Eigen::VectorXd squared_frequencies(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K);

// Undamped modes K x = w^2 M x, ascending, without those of zero stiffness and damping.
struct SpringModes {
  Eigen::VectorXd omega_squared;  // [rad^2/s^2]; negative: statically unstable
  Eigen::MatrixXd shapes;         // columns with x^T M x = 1
  Eigen::MatrixXd damping;        // X^T B X [1/s]; diagonal: 2 z w
  Eigen::Index size() const { return omega_squared.size(); }
  // Maximum frequency or damping rate [1/s].
  double max_rate() const {
    return std::max(std::sqrt(omega_squared.cwiseAbs().maxCoeff()), damping.cwiseAbs().maxCoeff());
  }
  // [rad/s]; 0 if w^2 <= 0
  double omega(Eigen::Index i) const { return std::sqrt(std::max(0.0, omega_squared[i])); }
  // Damping / (2 w); exact for proportional damping.
  double zeta(Eigen::Index i) const { return omega(i) > 0 ? damping(i, i) / (2 * omega(i)) : 0; }
};
SpringModes spring_modes(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K,
                         const Eigen::MatrixXd& B);

}  // namespace twinarm
