// Cavities: the inside of a sphere and of a tube with open ends, as walls.
#pragma once

#include "collision/shapes/cylinder.h"
#include "collision/shapes/shape_number.h"
#include "collision/shapes/sphere.h"

namespace twinarm {

struct SphericalCavity {
  static constexpr const char* name = "spherical cavity";
  static constexpr const char* key = "spherical_cavity";
  double radius = 1;  // [m], centred
  static constexpr auto lengths() {
    return std::make_tuple(std::pair("radius", &SphericalCavity::radius));
  }

  Vector3 support(const Vector3& d) const { return Sphere{radius}.support(d); }
};
SphericalCavity numbered(ShapeNumber<6>);

struct CylindricalCavity {
  static constexpr const char* name = "cylindrical cavity";
  static constexpr const char* key = "cylindrical_cavity";
  double radius = 1;  // [m]
  double length = 1;  // along z, centred [m]
  static constexpr auto lengths() {
    return std::make_tuple(std::pair("radius", &CylindricalCavity::radius),
                           std::pair("length", &CylindricalCavity::length));
  }

  Vector3 support(const Vector3& d) const { return Cylinder{radius, length}.support(d); }
};
CylindricalCavity numbered(ShapeNumber<7>);

}  // namespace twinarm
