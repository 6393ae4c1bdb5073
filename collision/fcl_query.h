// The narrow-phase questions that are put to FCL, and no others.
#pragma once

#include <memory>
#include <optional>

#include "collision/polytope.h"
#include "collision/shape.h"
#include "solver/pose.h"

namespace twinarm {

// Which body FCL is shown. The radius of spheres and capsules is always taken off (they are a point
// and a segment); cylinders, whose penetrations FCL gets wrong, can be eroded, in growing sizes.
enum class Core { whole, eroded_by_a_tenth, by_a_third, by_two_thirds, by_nine_tenths };
constexpr int core_count = 5;

// FCL's geometry of one shape. Shared and const: may be asked from several threads.
class FclShape {
 public:
  FclShape(const Shape& shape, const Polytope& core);
  struct Impl;
  const Impl* impl() const { return impl_.get(); }
  double erosion(Core core) const;  // how much of the surface is taken off [m]

 private:
  std::shared_ptr<const Impl> impl_;
};

struct CoreDistance {
  double distance = 0;             // between the cores; 0 where they overlap, or FCL failed [m]
  Vector3 p_WA = Vector3::Zero();  // nearest points
  Vector3 p_WB = Vector3::Zero();
};

// Unsigned distance (GJK). 1-15 us.
CoreDistance core_distance(const FclShape& a, const Pose& X_WA, const FclShape& b, const Pose& X_WB,
                           Core core);

// A direction from A to B out of a deep penetration (libccd's MPR). It is often wrong for curved
// shapes: check it with overlap().
std::optional<Vector3> penetration_direction(const FclShape& a, const Pose& X_WA, const FclShape& b,
                                             const Pose& X_WB);

}  // namespace twinarm
