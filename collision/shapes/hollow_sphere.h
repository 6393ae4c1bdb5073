// The inside of a sphere, as a wall.
#pragma once

#include "collision/shapes/shape_number.h"
#include "collision/shapes/sphere.h"

namespace twinarm {

struct SphericalCavity {  // the inside: bodies move within
  static constexpr const char* name = "hollow sphere";
  static constexpr const char* key = "hollow_sphere";
  double radius = 1;  // [m], centred
  static constexpr auto lengths() {
    return std::make_tuple(std::pair("radius", &SphericalCavity::radius));
  }

  Vector3 support(const Vector3& d) const { return Sphere{radius}.support(d); }
};
SphericalCavity numbered(ShapeNumber<6>);

}  // namespace twinarm
