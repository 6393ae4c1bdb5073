// An ellipsoid, centred, with semi-axes along the axes.
#pragma once

#include <numbers>
#include <tuple>

#include "collision/geometry/convex_hull.h"
#include "collision/geometry/mass_properties.h"
#include "collision/shapes/shape_number.h"

namespace twinarm {

struct Ellipsoid {
  static constexpr const char* name = "ellipsoid";
  static constexpr const char* key = "ellipsoid";
  Vector3 semi_axes = Vector3::Ones();  // along the axes, centred [m]
  static constexpr auto lengths() {
    return std::make_tuple(std::pair("semi_axes", &Ellipsoid::semi_axes));
  }

  Vector3 support(const Vector3& d) const {
    const Vector3 scaled = semi_axes.cwiseProduct(d);
    return semi_axes.cwiseProduct(scaled) / scaled.norm();
  }
  MassProperties solid(double density) const {
    const double m = density * 4.0 / 3.0 * std::numbers::pi * semi_axes.prod();
    const Vector3 q = m / 5 * semi_axes.cwiseAbs2();
    return centred_solid(m, q.y() + q.z(), q.x() + q.z(), q.x() + q.y());
  }
  BoundaryFeatures boundary() const {
    BoundaryFeatures boundary;
    boundary.quadrics = {{Vector3::Zero(), Matrix3(semi_axes.cwiseAbs2().asDiagonal())}};
    boundary.min_radius = semi_axes.minCoeff() * semi_axes.minCoeff() / semi_axes.maxCoeff();
    return boundary;
  }
};
Ellipsoid numbered(ShapeNumber<5>);

}  // namespace twinarm
