// Small motions about a state: x' = A x + B tau, x = (dq; dqd), and the modes of A.
//
//   A = ( W               1            )      B = ( 0    )
//       ( dqdd/dq         dqdd/dqd     )          ( M^-1 )
// The passes are differentiated by dual numbers (solver/dynamics/derivatives.h) with the outside
// forces fixed to the bodies; how those change with the state comes by central differences of what
// pushes (Richardson's extrapolation to order 6), through M^-1 in O(n) for each direction. dq are
// steps along the joints' groups, dq = log(q_0^-1 q), so W = -[w]x of joints that turn freely.
// Joints that follow others are eliminated: all is by the velocities that follow nobody.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <vector>

#include "solver/dynamics/kinematics.h"
#include "solver/model/workspace.h"

namespace twinarm {

// Adds all that pushes at a state: must be smooth there.
using AppliedForces = std::function<void(const State<double>&, const Kinematics&, Forces<double>&)>;

struct LinearSystem {
  std::vector<std::size_t> dofs;  // velocity index of each row of dq
  Eigen::MatrixXd A, B;           // 2n x 2n, 2n x n
};
// Of the first `dof_count` velocities; what moves by the others is not coupled to them by inertia.
LinearSystem linearise(const Model<double>& model, const State<double>& x,
                       const AppliedForces& push, std::size_t dof_count);

struct Mode {
  std::complex<double> eigenvalue;  // imaginary part >= 0: one for each pair [1/s]
  Eigen::VectorXcd shape;           // dq; its largest component is 1
  double frequency() const { return std::abs(eigenvalue); }  // undamped [rad/s]
  // -Re / |eigenvalue|, 0 for an eigenvalue of 0.
  double damping_ratio() const;
};
// Ascending frequency. Eigenvalues that are zero by the rank of A are exactly zero.
std::vector<Mode> modes_of(const Eigen::MatrixXd& A);

}  // namespace twinarm
