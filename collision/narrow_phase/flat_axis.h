// The best of the directions that are known beforehand: normals of faces and caps.
#pragma once

#include <vector>

#include "collision/narrow_phase/posed_shape.h"

namespace twinarm {

// Keeps its arrays from call to call, so that a step does not allocate.
class FlatAxis {
 public:
  // Least overlap among all flats of both bodies; n stays zero where there are none. False if one
  // of them parts the bodies by more than `margin`.
  bool best(const Placed& a, const Placed& b, double margin, Axis& axis);

 private:
  bool try_flats(const Placed& a, const Placed& b, const Placed& own, double sign, double margin,
                 Axis& axis);
  bool best_of_polytopes(const Placed& a, const Placed& b, double margin, Axis& axis);
  bool try_slabs(const Polytope& own, const Polytope& other, const Pose& X_own_other, double sign,
                 double margin, const Matrix3& R_W_own, double radii, Axis& axis);

  std::vector<Vector3> vertices_;
  std::vector<double> bounds_;  // by flat
};

}  // namespace twinarm
