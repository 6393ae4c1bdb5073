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
// o is the mean of the vertices, not the origin: no cancellation for parts far from their frame.
#include "collision/geometry/mass_properties.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "collision/geometry/convex_hull.h"
#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

[[noreturn]] void refuse(const std::string& problem, const std::string& fix) {
  throw InputError("mass properties", problem, fix, "mesh.mass");
}

Matrix3 outer(const Vector3& v) {
  return v * v.transpose();
}

Matrix3 inertia_of(const Matrix3& second_moment) {
  return second_moment.trace() * Matrix3::Identity() - second_moment;
}

void check_positive(const char* name, double value, const char* unit, const char* fix) {
  if (value > 0 && std::isfinite(value)) return;
  refuse(std::string(name) + " is " + short_number_text(value) + " " + unit + ", must be positive",
         fix);
}

}  // namespace

void check_density(double density) {
  check_positive("density", density, "kg/m^3", "give the density of the material");
}

MassProperties ConvexHull::solid(double density) const {
  return mass_properties(TriangleMesh{vertices, triangles}, density);
}

MassProperties with_mass(MassProperties properties, double mass) {
  check_positive("mass", mass, "kg", "give the mass of the body");
  properties.inertia *= mass / properties.mass;
  properties.mass = mass;
  return properties;
}

MassProperties mass_properties(const TriangleMesh& mesh, double density) {
  check_density(density);
  if (!is_closed(mesh))
    refuse("the surface is not closed: an edge has not exactly one triangle on each side",
           "repair the mesh (holes, doubled or flipped triangles), or give the inertia");
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
  if (!(volume > 0))
    refuse("the mesh encloses " + short_number_text(volume) + " m^3, must be positive",
           "orient the triangles counter-clockwise seen from outside");
  const Vector3 com = first / volume;  // from o
  return {density * volume, o + com, density * inertia_of(second - volume * outer(com))};
}

MassProperties combine(std::span<const MassProperties> parts) {
  MassProperties sum;
  for (const MassProperties& part : parts) {
    sum.mass += part.mass;
    sum.com += part.mass * part.com;
  }
  if (!(sum.mass > 0))
    refuse("the parts sum to " + short_number_text(sum.mass) + " kg, must be positive",
           "give at least one part with mass; holes may not outweigh the solids");
  sum.com /= sum.mass;
  for (const MassProperties& part : parts) {  // parallel axes (Steiner)
    sum.inertia += part.inertia + part.mass * inertia_of(outer(part.com - sum.com));
  }
  return sum;
}

}  // namespace twinarm
