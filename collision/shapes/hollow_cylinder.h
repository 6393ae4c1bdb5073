// The inside of an open tube, as a wall.
#pragma once

#include "collision/shapes/cylinder.h"
#include "collision/shapes/shape_number.h"

namespace twinarm {

struct CylindricalCavity {  // the inside of a tube with open ends
  static constexpr const char* name = "hollow cylinder";
  static constexpr const char* key = "hollow_cylinder";
  double radius = 1;  // [m]
  double length = 1;  // [m], along z, centred
  static constexpr auto lengths() {
    return std::make_tuple(std::pair("radius", &CylindricalCavity::radius),
                           std::pair("length", &CylindricalCavity::length));
  }

  Vector3 support(const Vector3& d) const { return Cylinder{radius, length}.support(d); }
};
CylindricalCavity numbered(ShapeNumber<7>);

}  // namespace twinarm
