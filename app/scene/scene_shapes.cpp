// Inertia of solids of mass m about their centre. With the semi-axes or half edges (a, b, c) of an
// ellipsoid or box,
//   I_xx = m (b^2 + c^2) / n,   n = 5 (ellipsoid), 3 (box)
// cylinder, axis z    I_zz = m r^2 / 2,   I_xx = m (3 r^2 + l^2) / 12
// capsule             the cylinder, and two half balls of mass m_s / 2 at the distance l/2 + 3r/8:
//   I_zz = m_c r^2 / 2 + 2 m_s r^2 / 5,
//   I_xx = m_c (3 r^2 + l^2) / 12 + m_s (2 r^2 / 5 + l^2 / 4 + 3 l r / 8)
#include "app/scene/scene_shapes.h"

#include <numbers>
#include <stdexcept>

#include "collision/convex_hull.h"
#include "collision/import/mesh_geometry.h"

namespace twinarm {
namespace {

constexpr double kPi = std::numbers::pi;

MassProperties centred(double mass, double xx, double yy, double zz) {
  return {mass, Vector3::Zero(), Vector3(xx, yy, zz).asDiagonal()};
}

MassProperties with_axes(double mass, const Vector3& axes, double n) {
  const Vector3 s = axes.cwiseProduct(axes) / n;
  return centred(mass, mass * (s.y() + s.z()), mass * (s.x() + s.z()), mass * (s.x() + s.y()));
}

MassProperties cylinder(double density, double r, double l) {
  const double mass = density * kPi * r * r * l, across = mass * (3 * r * r + l * l) / 12;
  return centred(mass, across, across, mass * r * r / 2);
}

ConvexHull hull_of(const MeshGeometry& mesh) {
  return convex_hull(load_mesh(mesh).vertices);
}

struct SolidProperties {
  double density;
  MassProperties operator()(const BoxGeometry& box) const {
    return with_axes(density * box.size.prod(), box.size / 2, 3);
  }
  MassProperties operator()(const SphereGeometry& sphere) const {
    return (*this)(EllipsoidSpec{Vector3::Constant(sphere.radius)});
  }
  MassProperties operator()(const EllipsoidSpec& e) const {
    return with_axes(density * 4 / 3 * kPi * e.semi_axes.prod(), e.semi_axes, 5);
  }
  MassProperties operator()(const CylinderGeometry& c) const {
    return cylinder(density, c.radius, c.length);
  }
  MassProperties operator()(const CapsuleGeometry& c) const {
    const double r = c.radius, l = c.length, balls = density * 4 / 3 * kPi * r * r * r;
    MassProperties sum = cylinder(density, r, l);
    const double across = balls * (0.4 * r * r + l * l / 4 + 3 * l * r / 8);
    sum.mass += balls;
    sum.inertia += Vector3(across, across, 0.4 * balls * r * r).asDiagonal();
    return sum;
  }
  MassProperties operator()(const MeshSpec& spec) const {
    if (!spec.convex) return mass_properties(load_mesh(spec.mesh), density);
    const ConvexHull hull = hull_of(spec.mesh);
    return mass_properties({hull.vertices, hull.triangles}, density);
  }
  template <class NoInside>
  MassProperties operator()(const NoInside&) const {
    throw std::invalid_argument("a shape without inside has no mass");
  }
};

[[noreturn]] void refuse(const std::string& shape) {
  throw InputError({{"", 0, "shape", "contacts do not know " + shape + " yet",
                     "give another shape, or keep it apart from all others"}});
}

struct ToCollision {
  Shape operator()(const BoxGeometry& box) const { return Box{box.size}; }
  Shape operator()(const SphereGeometry& sphere) const { return Sphere{sphere.radius}; }
  Shape operator()(const CapsuleGeometry& c) const { return Capsule{c.radius, c.length}; }
  Shape operator()(const CylinderGeometry& c) const { return Cylinder{c.radius, c.length}; }
  Shape operator()(const HalfSpaceSpec& half) const { return HalfSpace{half.normal, half.offset}; }
  Shape operator()(const EllipsoidSpec&) const { refuse("an ellipsoid"); }
  Shape operator()(const HollowSphereSpec&) const { refuse("a hollow sphere"); }
  Shape operator()(const HollowCylinderSpec&) const { refuse("a hollow cylinder"); }
  Shape operator()(const MeshSpec& spec) const {
    if (!spec.convex) refuse("a mesh that is not convex");
    return hull_of(spec.mesh);
  }
};

}  // namespace

MassProperties solid_properties(const ShapeSpec& shape, double density) {
  return std::visit(SolidProperties{density}, shape);
}

Shape collision_shape(const ShapeSpec& shape) {
  return std::visit(ToCollision{}, shape);
}

}  // namespace twinarm
