// A cylinder: two caps, a side and two rims.
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
  double length = 1;  // [m], along z, centred
  static constexpr auto lengths() {
    return std::make_tuple(std::pair("radius", &Cylinder::radius),
                           std::pair("length", &Cylinder::length));
  }

  Vector3 support(const Vector3& d) const {
    const double radial = std::hypot(d.x(), d.y());
    // Along the axis the whole cap is farthest; its centre is as good a point as any.
    const double k = radial > 1e-14 * std::abs(d.z()) ? radius / radial : 0;
    return {k * d.x(), k * d.y(), std::copysign(length / 2, d.z())};
  }
  MassProperties solid(double density) const {
    const double rr = radius * radius, m = density * std::numbers::pi * rr * length;
    const double across = m * (rr / 4 + length * length / 12);
    return centred_solid(m, across, across, m * rr / 2);
  }
  Patches patches() const {
    Patches patches;
    const Vector3 top(0, 0, length / 2);
    const Vector3 squares(radius * radius, radius * radius, 0);
    patches.flats = {Vector3::UnitZ(), -Vector3::UnitZ()};
    patches.ridges = {{-top, top, radius}};
    patches.rounds = {{top, Matrix3(squares.asDiagonal())}, {-top, Matrix3(squares.asDiagonal())}};
    patches.sharpest = std::min(radius, length / 2);
    return patches;
  }
  SignedPoint nearest(const Vector3& p) const {
    const double rho = std::hypot(p.x(), p.y()), half = length / 2;
    const Vector3 radial =
        rho > SignedPoint::touching ? Vector3(p.x() / rho, p.y() / rho, 0) : Vector3::UnitX();
    const Vector3 axial(0, 0, std::copysign(1.0, p.z()));
    const double side = rho - radius, cap = std::abs(p.z()) - half;
    if (side > SignedPoint::touching && cap > SignedPoint::touching) {
      const Vector3 n = side * radial + cap * axial;
      return {n.norm(), n.normalized()};
    }
    return side > cap ? SignedPoint{side, radial} : SignedPoint{cap, axial};
  }
  // Calls add(point, name) for those that may lie on a plane across d, farthest along d. Standing:
  // the farthest point of its rim and three more, at quarter turns from it. Lying: the farthest
  // points of both rims. All on the true rims, and smooth functions of the pose.
  template <class Add>
  void max_points(const Vector3& d, Add add) const {
    constexpr double flat = 1e-6;  // a cap that is tilted less lies flat: its points are then fixed
    const double sine = std::hypot(d.x(), d.y()), z = std::copysign(length / 2, d.z());
    const bool lies_flat = sine < flat;
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
