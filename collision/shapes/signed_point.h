// The distance of a point from the surface of a shape.
#pragma once

#include "solver/spatial/pose.h"

namespace twinarm {

// Where a point is, seen from the surface of a shape.
struct SignedPoint {
  static constexpr double touching = 1e-12;  // nearer than this it has no direction of its own [m]
  double distance;                           // negative inside [m]
  Vector3 normal;                            // outward, unit
};

}  // namespace twinarm
