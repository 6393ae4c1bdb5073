// A box, centred, with edges along the axes.
#pragma once

#include <cmath>
#include <tuple>

#include "collision/geometry/convex_hull.h"
#include "collision/geometry/mass_properties.h"
#include "collision/shapes/shape_number.h"
#include "collision/shapes/signed_point.h"

namespace twinarm {

struct Box {
  static constexpr const char* name = "box";
  static constexpr const char* key = "box";
  static constexpr bool is_in_urdf = true;
  Vector3 size = Vector3::Ones();  // edge lengths, along the axes, centred [m]
  static constexpr auto lengths() { return std::make_tuple(std::pair("size", &Box::size)); }

  Vector3 support(const Vector3& d) const {
    return 0.5 * Vector3(std::copysign(size.x(), d.x()), std::copysign(size.y(), d.y()),
                         std::copysign(size.z(), d.z()));
  }
  MassProperties solid(double density) const {
    const double m = density * size.prod();
    const Vector3 q = m / 12 * size.cwiseAbs2();
    return centred_solid(m, q.y() + q.z(), q.x() + q.z(), q.x() + q.y());
  }
  Polytope polytope() const { return box_hull(size).polytope(); }
  SignedPoint nearest(const Vector3& p) const {
    const Vector3 half = size / 2;
    const Vector3 outside = p - p.cwiseMax(-half).cwiseMin(half);
    if (outside.norm() > SignedPoint::kTouching) return {outside.norm(), outside.normalized()};
    int axis = 0;
    const double inside = (half - p.cwiseAbs()).minCoeff(&axis);
    return {-inside, std::copysign(1.0, p[axis]) * Vector3::Unit(axis)};
  }
};
Box numbered(ShapeNumber<1>);

}  // namespace twinarm
