// Linearisation about a state: x' = A x + B tau, x = (dq; dqd), and the modes of A.
//
//   A = ( W               1            )      B = ( 0    )
//       ( dqdd/dq         dqdd/dqd     )          ( M^-1 )
// The passes are differentiated by solver/dynamics/derivatives.h, with applied forces constant in
// body axes. The derivatives of the applied forces are central differences (Richardson
// extrapolation to order 6), multiplied by M^-1 in O(n) per direction. dq = log(q_0^-1 q) on the
// configuration group, so W = -[w]x for spherical and free joints. Mimic joints are eliminated.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <string>
#include <vector>

#include "app/run/simulate_input.h"
#include "coupling/analysis/joint_space_stiffness.h"
#include "solver/loops/loop_closure.h"

namespace twinarm {

struct LinearSystem {
  std::vector<std::size_t> dofs;  // velocity index of each row of dq
  Eigen::MatrixXd A, B;           // 2n x 2n, 2n x n
};
LinearSystem linearise(const Model<double>& model, const State<double>& x,
                       const AppliedForces& push);

inline Eigen::Index signed_index(std::size_t i) {
  return static_cast<Eigen::Index>(i);
}

// Richardson extrapolation of central differences with steps s, s/2 and s/4, to order 6.
// combine(a, by_a, b, by_b) sets b = by_a a + by_b b.
template <class Difference, class Combine>
auto extrapolated_rate(double s, const Difference& difference, const Combine& combine) {
  std::array rate{difference(s), difference(s / 2), difference(s / 4)};
  double factor = 4;
  for (std::size_t last = 2; last > 0; --last, factor *= 4)
    for (std::size_t k = 0; k < last; ++k)
      combine(rate[k + 1], 1 + 1 / (factor - 1), rate[k], -1 / (factor - 1));
  return rate[0];
}

struct Mode {
  std::complex<double> eigenvalue;  // imaginary part >= 0: one for each pair [1/s]
  Eigen::VectorXcd shape;           // dq; its largest component is 1
  double frequency() const { return std::abs(eigenvalue); }  // undamped [rad/s]
  // -Re / |eigenvalue|, 0 for an eigenvalue of 0.
  double damping_ratio() const {
    return eigenvalue == 0.0 ? 0 : -eigenvalue.real() / std::abs(eigenvalue);
  }
};
Mode scaled(Mode mode);  // its largest component to 1
// By ascending frequency. Eigenvalues that vanish by the rank of A are exactly zero.
std::vector<Mode> modes_of(const Eigen::MatrixXd& A);

// Linearisation on the tangent space of closed loops.
//
// x = (q; qd) with g(q) = 0 and J qd = 0. Independent coordinates y = P dq are some of the dq; the
// others depend on them, dq = Z y with J Z = 0, P Z = 1. Then y' = P qd, y'' = P qdd, and to first
// order
//   dqd  = Z y' + L y      J L = -d(J qd)/dq Z,    P L = 0
//   dqdd = Z y'' + N       J N = -d(J qdd + gamma), P N = 0
// (L = N = 0 at rest in equilibrium). With a = M^-1 (tau - h + J^T lambda), lambda constant, and
// its derivatives a_q, a_qd with respect to all coordinates,
//   Z^T M Z y'' = Z^T M (a_q Z y + a_qd (Z y' + L y) - N);
// Z^T J^T = 0 eliminates the change of lambda. Redundant loops are permitted.
struct LoopedSystem {
  LinearSystem system;      // by y: dofs are those of P
  Eigen::MatrixXd Z;        // nv x ny: all velocities of y'
  std::vector<double> qdd;  // at x, by velocity
};

// At a state that satisfies the loops (possibly none) in position and velocity. `push`: applied
// forces without those of loops and mimic joints. Velocities in `still` are fixed to zero.
LoopedSystem linearise_with_loops(const Model<double>& model, const State<double>& x,
                                  const AppliedForces& push, const std::vector<LoopClosure>& loops,
                                  const std::vector<std::size_t>& still = {});

// Shape of a mode of the reduced system in all velocities; the largest component is 1.
Mode by_all_velocities(const LoopedSystem& looped, const Mode& mode);

// `twinarm modes`: linearisation of a robot or scene about its state, with its constraints.

struct ModesOf {
  LoopedSystem looped;
  std::vector<Mode> modes;         // by all velocities of the model
  std::vector<NamedJoint> joints;  // of shapes: those of robots, then bodies with constraints
  std::vector<std::string> rows;   // names of dq, the rows of A
  std::vector<std::string> warnings;
};
// At the state of the input, its velocities projected on the constraints.
ModesOf find_modes(SimulateInput& input);

std::string modes_json(const SimulateInput& input, const ModesOf& found);
std::string modes_table(const SimulateInput& input, const ModesOf& found);

}  // namespace twinarm
