// Polyhedral mass properties as a sum of signed tetrahedra. O(triangles), exact for polyhedra.
//
// A triangle (a, b, c) and the point o span a tetrahedron with six times the signed volume
// d = a . (b x c), coordinates from o; the tetrahedra of a closed surface sum to its inside. With
// s = a + b + c:
//   volume           V = sum d / 6
//   first moment     M = sum d s / 24
//   second moment    P = int x x^T dV = sum d (a a^T + b b^T + c c^T + s s^T) / 120
//   inertia about o  I = tr(P) 1 - P
// B. Mirtich, "Fast and accurate computation of polyhedral mass properties", J. Graphics Tools
// 1(2), 1996 (the same integrals by the divergence theorem); F. Tonon, "Explicit exact formulas for
// the 3-D tetrahedron inertia tensor in terms of its vertex coordinates", J. Math. Stat. 1(1),
// 2004.
//
// o is the mean of the vertices, not the origin: a part far from its frame loses no digits.
#include "collision/shapes/mass_properties.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

[[noreturn]] void refuse(const std::string& rule, const std::string& remedy) {
  throw InputError({{"", 0, "mass properties", rule, remedy}});
}

Matrix3 outer(const Vector3& v) {
  return v * v.transpose();
}

Matrix3 inertia_of(const Matrix3& second_moment) {
  return second_moment.trace() * Matrix3::Identity() - second_moment;
}

void check_positive(const char* name, double value, const char* unit, const char* remedy) {
  if (value > 0 && std::isfinite(value)) return;
  refuse(std::string(name) + " is " + std::to_string(value) + " " + unit + ", must be positive",
         remedy);
}

MassProperties centred(double mass, double xx, double yy, double zz) {
  return {mass, Vector3::Zero(), Matrix3(Vector3(xx, yy, zz).asDiagonal())};
}

// Textbook inertias about the centre.
struct OfShape {
  double density;
  MassProperties operator()(const Sphere& s) const {
    return (*this)(Ellipsoid{Vector3::Constant(s.radius)});
  }
  MassProperties operator()(const Ellipsoid& e) const {
    const double m = density * 4.0 / 3.0 * std::numbers::pi * e.semi_axes.prod();
    const Vector3 q = m / 5 * e.semi_axes.cwiseAbs2();
    return centred(m, q.y() + q.z(), q.x() + q.z(), q.x() + q.y());
  }
  MassProperties operator()(const Box& b) const {
    const double m = density * b.size.prod();
    const Vector3 q = m / 12 * b.size.cwiseAbs2();
    return centred(m, q.y() + q.z(), q.x() + q.z(), q.x() + q.y());
  }
  MassProperties operator()(const Cylinder& c) const {
    const double rr = c.radius * c.radius, m = density * std::numbers::pi * rr * c.length;
    const double across = m * (rr / 4 + c.length * c.length / 12);
    return centred(m, across, across, m * rr / 2);
  }
  // A cylinder and two half balls, whose centres of mass are 3 r / 8 beyond its ends.
  MassProperties operator()(const Capsule& c) const {
    const MassProperties side = (*this)(Cylinder{c.radius, c.length});
    const MassProperties ball = (*this)(Sphere{c.radius});
    const double l = c.length, shift = ball.mass * (l * l / 4 + 3 * c.radius * l / 8);
    return centred(side.mass + ball.mass, side.inertia(0, 0) + ball.inertia(0, 0) + shift,
                   side.inertia(1, 1) + ball.inertia(1, 1) + shift,
                   side.inertia(2, 2) + ball.inertia(2, 2));
  }
  MassProperties operator()(const ConvexHull& hull) const {
    return mass_properties(TriangleMesh{hull.vertices, hull.triangles}, density);
  }
  MassProperties operator()(const MeshShape& shape) const {
    return mass_properties(shape.mesh, density);
  }
  MassProperties operator()(const HalfSpace&) const { return none("half-space"); }
  MassProperties operator()(const HollowSphere&) const { return none("hollow sphere"); }
  MassProperties operator()(const HollowCylinder&) const { return none("hollow cylinder"); }
  static MassProperties none(const char* name) {
    refuse(std::string("a ") + name + " encloses no solid", "give the inertia of its body");
  }
};

}  // namespace

MassProperties mass_properties(const Shape& shape, double density) {
  check_positive("density", density, "kg/m^3", "give the density of the material");
  const std::string fault = shape_fault(shape);
  if (!fault.empty()) refuse(shape_name(shape) + ": " + fault, "correct the shape");
  return std::visit(OfShape{density}, shape);
}

MassProperties with_mass(MassProperties properties, double mass) {
  check_positive("mass", mass, "kg", "give the mass of the body");
  properties.inertia *= mass / properties.mass;
  properties.mass = mass;
  return properties;
}

MassProperties mass_properties(const TriangleMesh& mesh, double density) {
  check_positive("density", density, "kg/m^3", "give the density of the material");
  if (!is_closed(mesh)) {
    refuse("the surface is not closed: an edge has not exactly one triangle on each side",
           "repair the mesh (holes, doubled or flipped triangles), or give the inertia");
  }
  Vector3 o = Vector3::Zero();
  for (const Vector3& v : mesh.vertices) o += v / static_cast<double>(mesh.vertices.size());

  double volume = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3 a = mesh.vertices[i] - o, b = mesh.vertices[j] - o, c = mesh.vertices[k] - o;
    const Vector3 s = a + b + c;
    const double d = a.dot(b.cross(c));
    volume += d / 6;
    first += d / 24 * s;
    second += d / 120 * (outer(a) + outer(b) + outer(c) + outer(s));
  }
  if (!(volume > 0)) {
    refuse("the mesh encloses " + std::to_string(volume) + " m^3, must be positive",
           "turn the triangles counter-clockwise seen from outside");
  }
  const Vector3 com = first / volume;  // from o
  return {density * volume, o + com, density * inertia_of(second - volume * outer(com))};
}

MassProperties combine(std::span<const MassProperties> parts) {
  MassProperties sum;
  for (const MassProperties& part : parts) {
    sum.mass += part.mass;
    sum.com += part.mass * part.com;
  }
  if (!(sum.mass > 0)) {
    refuse("the parts sum to " + std::to_string(sum.mass) + " kg, must be positive",
           "give at least one part with mass; holes may not outweigh the solids");
  }
  sum.com /= sum.mass;
  for (const MassProperties& part : parts) {  // parallel axes (Steiner)
    sum.inertia += part.inertia + part.mass * inertia_of(outer(part.com - sum.com));
  }
  return sum;
}

}  // namespace twinarm
