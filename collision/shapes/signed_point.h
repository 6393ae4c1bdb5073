// Signed distance of a point from the surface of a shape.
#pragma once

#include "solver/spatial/pose.h"

namespace twinarm {

struct SignedPoint {
  static constexpr double kTouching = 1e-12;  // below it the direction is undefined [m]
  double distance;                            // negative inside [m]
  Vector3 normal;                             // outward, unit
};

}  // namespace twinarm
