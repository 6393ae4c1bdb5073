// Joint-space stiffness and damping about a pose, and their modes.
//
// Of springs at points p with pulls F_p, tau = sum_p J_p^T F_p, so
//   K_q = -d tau/dq = sum_p J_p^T k_p J_p - sum_p (dJ_p^T/dq) F_p.
// The first sum is K_q about zero offset (Coupling::joint_space); the second, the geometric
// stiffness, is there only where the springs pull.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/kinematics.h"
#include "solver/model/workspace.h"

namespace twinarm {

// The generalised force of what pushes, by velocities of the model; O(n).
Eigen::VectorXd generalised_force(const Model<double>& model, const State<double>& x,
                                  const Forces<double>& forces);

// Adds all that pushes at a state: must be smooth there.
using PushesAt = std::function<void(const State<double>&, const Kinematics&, Forces<double>&)>;

// K = -d tau/dq and B = -d tau/dqd of what pushes, geometric stiffness included; dq are steps along
// the joints' groups. By central differences, extrapolated twice: to about 1e-9 of its size for
// offsets of a few tenths of a radian. O(n) for each velocity.
struct TangentStiffness {
  Eigen::MatrixXd K, B;
};
// Along the first `count` velocities; the other columns are 0.
TangentStiffness tangent_stiffness(const Model<double>& model, const State<double>& x,
                                   const PushesAt& push, std::size_t count);
inline TangentStiffness tangent_stiffness(const Model<double>& model, const State<double>& x,
                                          const PushesAt& push) {
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
