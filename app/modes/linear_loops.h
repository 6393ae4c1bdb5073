// Small motions of a mechanism that closed loops hold: linear_system.h on the constraint's tangent.
//
// x = (q; qd) stays where g(q) = 0 and J qd = 0. A point of it is told by some of the coordinates,
// y = P dq, the others follow: dq = Z y with J Z = 0, P Z = 1. y is linear in q, so y' = P qd and
// y'' = P qdd, and to the first order
//   dqd  = Z y' + L y      J L = -d(J qd)/dq Z,    P L = 0
//   dqdd = Z y'' + N       J N = -d(J qdd + gamma), P N = 0
// (L and N are zero at rest in equilibrium). With a = M^-1 (tau - h + J^T lambda), lambda kept at
// what holds the loops at x, and its derivatives a_q, a_qd of all coordinates (linear_system.h),
//   Z^T M Z y'' = Z^T M (a_q Z y + a_qd (Z y' + L y) - N),
// for Z^T J^T = 0 takes the change of lambda out. Redundant loops do no harm: Z is all that counts.
#pragma once

#include "app/modes/linear_system.h"
#include "solver/loops/loop_closure.h"

namespace twinarm {

struct LoopedSystem {
  LinearSystem system;      // by y: dofs are those of P
  Eigen::MatrixXd Z;        // nv x ny: all velocities of y'
  std::vector<double> qdd;  // at x, by velocity
};

// At a state that satisfies the loops, in place and in velocity. `push` is without what holds the
// loops and without what keeps followers to their leaders. Velocities in `still` do not move: what
// they belong to is left out. The loops may be none.
LoopedSystem linearise_with_loops(const Model<double>& model, const State<double>& x,
                                  const AppliedForces& push, const std::vector<LoopClosure>& loops,
                                  const std::vector<std::size_t>& still = {});

// A mode of the reduced system by all velocities; the largest part is 1 again.
Mode by_all_velocities(const LoopedSystem& looped, const Mode& mode);

}  // namespace twinarm
