// A cylinder about the z axis, centred.
#pragma once

#include <cmath>
#include <numbers>
#include <tuple>

#include "collision/geometry/convex_hull.h"
#include "collision/geometry/mass_properties.h"
#include "collision/shapes/shape_number.h"
#include "collision/shapes/signed_point.h"

namespace twinarm {

struct Cylinder {
  static constexpr const char* name = "cylinder";
  static constexpr const char* key = "cylinder";
  static constexpr bool is_in_urdf = true;
  double radius = 1;  // [m]
  double length = 1;  // along z, centred [m]
  static constexpr auto lengths() {
    return std::make_tuple(std::pair("radius", &Cylinder::radius),
                           std::pair("length", &Cylinder::length));
  }

  Vector3 support(const Vector3& d) const {
    const double radial = std::sqrt(d.x() * d.x() + d.y() * d.y());  // hypot() takes longer
    // Along the axis all points of the cap are support points: take its centre.
    const double k = radial > 1e-14 * std::abs(d.z()) ? radius / radial : 0;
    return {k * d.x(), k * d.y(), std::copysign(length / 2, d.z())};
  }
  MassProperties solid(double density) const {
    const double rr = radius * radius, m = density * std::numbers::pi * rr * length;
    const double across = m * (rr / 4 + length * length / 12);
    return centred_solid(m, across, across, m * rr / 2);
  }
  BoundaryFeatures boundary() const {
    BoundaryFeatures boundary;
    const Vector3 top(0, 0, length / 2);
    const Vector3 squares(radius * radius, radius * radius, 0);
    boundary.face_normals = {Vector3::UnitZ(), -Vector3::UnitZ()};
    boundary.lines = {{-top, top, radius}};
    boundary.quadrics = {{top, Matrix3(squares.asDiagonal())},
                         {-top, Matrix3(squares.asDiagonal())}};
    boundary.min_radius = std::min(radius, length / 2);
    return boundary;
  }
  SignedPoint nearest(const Vector3& p) const {
    const double rho = std::hypot(p.x(), p.y()), half = length / 2;
    const Vector3 radial =
        rho > SignedPoint::kTouching ? Vector3(p.x() / rho, p.y() / rho, 0) : Vector3::UnitX();
    const Vector3 axial(0, 0, std::copysign(1.0, p.z()));
    const double side = rho - radius, cap = std::abs(p.z()) - half;
    if (side > SignedPoint::kTouching && cap > SignedPoint::kTouching) {
      const Vector3 n = side * radial + cap * axial;
      return {n.norm(), n.normalized()};
    }
    return side > cap ? SignedPoint{side, radial} : SignedPoint{cap, axial};
  }
  // Calls add(point, feature) for the points that can touch a plane with outward normal -d.
  // Upright: the support point of the rim and three more at quarter turns. Lying: the support
  // points of both rims. Smooth functions of the pose.
  template <class Add>
  void plane_contact_points(const Vector3& d, Add add) const {
    constexpr double kFlat = 1e-6;  // sine; a cap with a smaller tilt is flat: its points are fixed
    const double sine = std::hypot(d.x(), d.y()), z = std::copysign(length / 2, d.z());
    const bool lies_flat = sine < kFlat;
    const double x = lies_flat ? radius : radius * d.x() / sine;
    const double y = lies_flat ? 0 : radius * d.y() / sine;
    const int first = z > 0 ? 0 : 4;
    add(Vector3(x, y, z), first);
    if (sine > std::abs(d.z())) {
      add(Vector3(x, y, -z), 4 - first);
    } else {
      add(Vector3(-y, x, z), first + 1);
      add(Vector3(-x, -y, z), first + 2);
      add(Vector3(y, -x, z), first + 3);
    }
  }
};
Cylinder numbered(ShapeNumber<4>);

}  // namespace twinarm
