// Where the geometric stiffness of an implicit point spring stands against its limit
// (docs/coupling.md, 3): about a joint with inertia I, a spring at radius r whose target lies at
// radius R_K is stable only while
//
//   h^2 k r R_K < 4 I + 2 r^2 (h^2 k + h b).
//
// For every joint between the base and the link that carries the spring; radii are measured from
// the joint's axis. Linear theory of one joint at a time, the others held: on a chain it tells the
// order of the limit, and mostly which joint folds first.
#pragma once

#include "coupling/laws/coupling.h"

namespace twinarm {

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
