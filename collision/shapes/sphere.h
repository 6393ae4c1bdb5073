// A sphere (a point with a radius).
#pragma once

#include "collision/geometry/convex_hull.h"
#include "collision/shapes/ellipsoid.h"
#include "collision/shapes/shape_number.h"

namespace twinarm {

struct Sphere {
  static constexpr const char* name = "sphere";
  static constexpr const char* key = "sphere";
  static constexpr bool is_in_urdf = true;
  double radius = 1;  // [m], centred
  static constexpr auto lengths() { return std::make_tuple(std::pair("radius", &Sphere::radius)); }

  Vector3 support(const Vector3& d) const { return d.normalized() * radius; }
  MassProperties solid(double density) const {
    return Ellipsoid{Vector3::Constant(radius)}.solid(density);
  }
  Polytope polytope() const {
    Polytope p;
    p.hull.vertices = {Vector3::Zero()};
    p.radius = radius;
    return p;
  }
};
Sphere numbered(ShapeNumber<2>);

}  // namespace twinarm
