// A half-space: solid on one side of a plane.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "collision/shapes/shape_number.h"
#include "solver/spatial/pose.h"
#include "solver/support/number_text.h"

namespace twinarm {

struct HalfSpace {
  static constexpr const char* name = "half-space";
  static constexpr const char* key = "halfspace";
  Vector3 normal = Vector3::UnitZ();  // outward, unit
  double offset = 0;                  // solid where normal . x <= offset [m]

  // Infinite, except along the normal.
  Vector3 support(const Vector3& d) const {
    if (d.normalized().dot(normal) > 1 - 1e-12) return offset * normal;
    return d * std::numeric_limits<double>::infinity();
  }
  std::string fault() const {
    if (std::abs(normal.norm() - 1) < 1e-9 && std::isfinite(offset)) return "";
    return "normal has length " + short_number_text(normal.norm()) + ", must be 1";
  }
};
HalfSpace numbered(ShapeNumber<0>);

}  // namespace twinarm
