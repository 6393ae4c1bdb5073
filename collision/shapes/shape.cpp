// Supports and checks of the shapes. See shape.h.
#include "collision/shapes/shape.h"

#include <cmath>
#include <limits>

#include "collision/shapes/mesh_checks.h"

namespace twinarm {
namespace {

Vector3 support_of(const Sphere& s, const Vector3& d) {
  return d.normalized() * s.radius;
}

Vector3 support_of(const Box& box, const Vector3& d) {
  return 0.5 * Vector3(std::copysign(box.size.x(), d.x()), std::copysign(box.size.y(), d.y()),
                       std::copysign(box.size.z(), d.z()));
}

Vector3 support_of(const Capsule& c, const Vector3& d) {
  return d.normalized() * c.radius + Vector3(0, 0, std::copysign(c.length / 2, d.z()));
}

Vector3 support_of(const Cylinder& c, const Vector3& d) {
  const double radial = std::hypot(d.x(), d.y());
  // Along the axis the whole cap is farthest; its centre is as good a point as any.
  const double k = radial > 1e-14 * std::abs(d.z()) ? c.radius / radial : 0;
  return {k * d.x(), k * d.y(), std::copysign(c.length / 2, d.z())};
}

Vector3 support_of(const Ellipsoid& e, const Vector3& d) {
  const Vector3 scaled = e.semi_axes.cwiseProduct(d);
  return e.semi_axes.cwiseProduct(scaled) / scaled.norm();
}

Vector3 support_of(const HollowSphere& s, const Vector3& d) {
  return support_of(Sphere{s.radius}, d);
}

Vector3 support_of(const HollowCylinder& c, const Vector3& d) {
  return support_of(Cylinder{c.radius, c.length}, d);
}

Vector3 support_of(const HalfSpace& h, const Vector3& d) {
  if (d.normalized().dot(h.normal) > 1 - 1e-12) return h.offset * h.normal;
  return d * std::numeric_limits<double>::infinity();
}

Vector3 highest_vertex(const std::vector<Vector3>& points, const Vector3& d) {
  std::size_t best = 0;
  double height = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double h = points[i].dot(d);
    if (h > height) {
      height = h;
      best = i;
    }
  }
  return points[best];
}

Vector3 support_of(const ConvexHull& hull, const Vector3& d) {
  return highest_vertex(hull.vertices, d);
}

Vector3 support_of(const MeshShape& shape, const Vector3& d) {
  return highest_vertex(shape.mesh.vertices, d);
}

std::string positive(const char* name, double value) {
  if (value > 0 && std::isfinite(value)) return "";
  return std::string(name) + " is " + std::to_string(value) + " m, must be positive";
}

std::string round_fault(double radius, double length) {
  const std::string fault = positive("radius", radius);
  return fault.empty() ? positive("length", length) : fault;
}

struct Faults {
  std::string operator()(const Sphere& s) const { return positive("radius", s.radius); }
  std::string operator()(const Box& b) const {
    for (int i = 0; i < 3; ++i) {
      const std::string fault = positive("size", b.size[i]);
      if (!fault.empty()) return fault;
    }
    return "";
  }
  std::string operator()(const Ellipsoid& e) const {
    for (int i = 0; i < 3; ++i) {
      const std::string fault = positive("semi-axis", e.semi_axes[i]);
      if (!fault.empty()) return fault;
    }
    return "";
  }
  std::string operator()(const Capsule& c) const { return round_fault(c.radius, c.length); }
  std::string operator()(const Cylinder& c) const { return round_fault(c.radius, c.length); }
  std::string operator()(const HollowSphere& s) const { return positive("radius", s.radius); }
  std::string operator()(const HollowCylinder& c) const { return round_fault(c.radius, c.length); }
  std::string operator()(const HalfSpace& h) const {
    if (std::abs(h.normal.norm() - 1) < 1e-9 && std::isfinite(h.offset)) return "";
    return "normal has length " + std::to_string(h.normal.norm()) + ", must be 1";
  }
  std::string operator()(const MeshShape& shape) const { return mesh_fault(shape); }
  std::string operator()(const ConvexHull& hull) const {
    if (hull.vertices.size() >= 4 && hull.faces.size() >= 4 &&
        hull.normals.size() == hull.faces.size()) {
      return "";
    }
    return "hull has " + std::to_string(hull.vertices.size()) +
           " vertices and no complete faces, must come from convex_hull()";
  }
};

}  // namespace

Vector3 support(const Shape& shape, const Vector3& direction) {
  return std::visit([&](const auto& s) { return support_of(s, direction); }, shape);
}

std::string shape_fault(const Shape& shape) {
  return std::visit(Faults{}, shape);
}

std::string shape_name(const Shape& shape) {
  static const char* const names[] = {
      "sphere",      "box",       "capsule",       "cylinder",        "half-space",
      "convex hull", "ellipsoid", "hollow sphere", "hollow cylinder", "triangle mesh"};
  return names[shape.index()];
}

}  // namespace twinarm
