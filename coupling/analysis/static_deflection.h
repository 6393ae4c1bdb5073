// What a coupling carries: sag under a load, what a wall feels like through it, and how far its
// target may be.
#pragma once

#include "coupling/laws/coupling.h"

namespace twinarm {

// Where a chain rests below its target [rad, m] under the generalised forces G, small angles:
// K_q^-1 G. Coordinates that no spring holds are not a number.
Eigen::VectorXd chain_sag(const Eigen::MatrixXd& K, const Eigen::VectorXd& G);

// Two springs in series: what a wall k_e feels like through a coupling k_c (Colgate, Stanley and
// Brown 1995). Either may be infinite.
double series_stiffness(double k_c, double k_e);

// A point spring at lever arm r, treated implicitly with step h on an inertia I about the joint, is
// stable only while its target's radius R_K stays below this [m] (docs/coupling.md, 3):
//   h^2 k r R_K < 4 I + 2 r^2 (h^2 k + h b).
double largest_target_radius(double I, double r, double k, double b, double h);

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

}  // namespace twinarm
