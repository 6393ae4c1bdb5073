// What a coupling carries: sag under a load, what a wall feels like through it, and how far its
// target may be.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "coupling/laws/coupling.h"
#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/kinematics.h"
#include "solver/model/workspace.h"

namespace twinarm {

// Where a chain rests below its target [rad, m] under the generalised forces G, small angles:
// K_q^-1 G. Coordinates that no spring holds are not a number.
Eigen::VectorXd chain_sag(const Eigen::MatrixXd& K, const Eigen::VectorXd& G);

// Two springs in series: what a wall k_e feels like through a coupling k_c (Colgate, Stanley and
// Brown 1995). Either may be infinite.
double series_stiffness(double k_c, double k_e);

// A point spring at lever arm r, treated implicitly with step h on an inertia I about the joint, is
// stable only while its target's radius R_K stays below this [m]
// (docs/understand/stability_of_spring_dampers.md):
//   h^2 k r R_K < 4 I + 2 r^2 (h^2 k + h b).
double max_target_radius(double I, double r, double k, double b, double h);

// Where a point spring stands against that limit. For every joint between the base and the link
// that carries the spring; radii are measured from the joint's axis. Linear theory of one joint at
// a time, the others held: on a chain it tells the order of the limit, and mostly which joint folds
// first.
struct TargetRadius {
  int body = 0;           // that the joint carries; 0: the spring turns no revolute joint
  double r = 0, R_K = 0;  // [m]
  double largest = 0;     // that R_K may have [m]
  double ratio() const { return body > 0 ? R_K / largest : 0; }  // above 1 it grows
};

// The joint that is nearest to its limit, or farthest beyond. D: where the DVR is, K: the KVR.
// O(n^2); allocates.
TargetRadius nearest_target_radius(const Model<double>& model, const State<double>& x,
                                   const Kinematics& D, const Kinematics& K, const Spring& spring,
                                   double h);

// Joint-space stiffness and damping about a pose, and their modes.
//
// Of springs at points p with pulls F_p, tau = sum_p J_p^T F_p, so
//   K_q = -d tau/dq = sum_p J_p^T k_p J_p - sum_p (dJ_p^T/dq) F_p.
// The first sum is K_q about zero offset (Coupling::joint_space); the second, the geometric
// stiffness, is there only where the springs pull.

// The generalised force of what pushes, by velocities of the model; O(n).
Eigen::VectorXd generalised_force(const Model<double>& model, const State<double>& x,
                                  const Forces<double>& forces);

// Adds all that pushes at a state: must be smooth there.
using AppliedForces = std::function<void(const State<double>&, const Kinematics&, Forces<double>&)>;

// K = -d tau/dq and B = -d tau/dqd of what pushes, geometric stiffness included; dq are steps along
// the joints' groups. By central differences, extrapolated twice: to about 1e-9 of its size for
// offsets of a few tenths of a radian. O(n) for each velocity.
struct TangentStiffness {
  Eigen::MatrixXd K, B;
};
// Along the first `count` velocities; the other columns are 0.
TangentStiffness tangent_stiffness(const Model<double>& model, const State<double>& x,
                                   const AppliedForces& push, std::size_t count);
inline TangentStiffness tangent_stiffness(const Model<double>& model, const State<double>& x,
                                          const AppliedForces& push) {
  return tangent_stiffness(model, x, push, model.nv);
}

// Eigenvalues of M^-1 K, ascending: squares of the natural frequencies [rad^2/s^2].
Eigen::VectorXd squared_frequencies(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K);

// Modes of the undamped motion, K x = w^2 M x, ascending; what neither K nor B holds is left out.
struct SpringModes {
  Eigen::VectorXd squares;  // w^2 [rad^2/s^2]; negative: the springs push away
  Eigen::MatrixXd shapes;   // columns with x^T M x = 1
  Eigen::MatrixXd damping;  // X^T B X [1/s]; its diagonal is 2 z w of each mode by itself
  Eigen::Index size() const { return squares.size(); }
  double fastest_rate() const;         // of what is fastest [1/s]
  double omega(Eigen::Index i) const;  // [rad/s]; 0 where w^2 is not positive
  double zeta(Eigen::Index i) const;   // damping / (2 w); exact where B goes with K and M
};
SpringModes spring_modes(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K,
                         const Eigen::MatrixXd& B);

}  // namespace twinarm
