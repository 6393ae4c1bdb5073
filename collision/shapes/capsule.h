// A capsule (a segment with a radius).
#pragma once

#include "collision/shapes/cylinder.h"
#include "collision/shapes/shape_number.h"
#include "collision/shapes/sphere.h"

namespace twinarm {

struct Capsule {
  static constexpr const char* name = "capsule";
  static constexpr const char* key = "capsule";
  static constexpr bool is_in_urdf = true;
  double radius = 1;  // [m]
  double length = 1;  // of the segment, along z, centred [m]
  static constexpr auto lengths() {
    return std::make_tuple(std::pair("radius", &Capsule::radius),
                           std::pair("length", &Capsule::length));
  }

  Vector3 support(const Vector3& d) const {
    return d.normalized() * radius + Vector3(0, 0, std::copysign(length / 2, d.z()));
  }
  // A cylinder and two hemispheres, whose centres of mass are 3 r / 8 beyond its ends.
  MassProperties solid(double density) const {
    const MassProperties side = Cylinder{radius, length}.solid(density);
    const MassProperties ball = Sphere{radius}.solid(density);
    const double shift = ball.mass * (length * length / 4 + 3 * radius * length / 8);
    return centred_solid(side.mass + ball.mass, side.inertia(0, 0) + ball.inertia(0, 0) + shift,
                         side.inertia(1, 1) + ball.inertia(1, 1) + shift,
                         side.inertia(2, 2) + ball.inertia(2, 2));
  }
  Polytope polytope() const {
    Polytope p;
    p.hull.vertices = {Vector3(0, 0, -length / 2), Vector3(0, 0, length / 2)};
    p.edges = {{0, 1, -1, -1}};
    p.radius = radius;
    return p;
  }
};
Capsule numbered(ShapeNumber<3>);

}  // namespace twinarm
