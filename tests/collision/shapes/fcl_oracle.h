// FCL's distance of two cores (collision/narrow_phase/gjk.h), as an independent result.
#pragma once

#include <memory>

#include "collision/geometry/convex_hull.h"
#include "collision/shapes/shape.h"
#include "solver/spatial/pose.h"

namespace twinarm::test {

// FCL's geometry of one shape, without the radius of spheres and capsules (point and segment).
// Shared and const: thread-safe.
class FclShape {
 public:
  FclShape(const Shape& shape, const Polytope& core);
  struct Impl;
  const Impl* impl() const { return impl_.get(); }

 private:
  std::shared_ptr<const Impl> impl_;
};

struct FclDistance {
  double distance = 0;             // between the cores; 0 if they overlap or FCL failed [m]
  Vector3 p_WA = Vector3::Zero();  // nearest points
  Vector3 p_WB = Vector3::Zero();
};

// Unsigned distance (GJK). 1-15 us.
FclDistance core_distance(const FclShape& a, const Pose& X_WA, const FclShape& b, const Pose& X_WB);

}  // namespace twinarm::test
