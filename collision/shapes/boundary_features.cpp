// See boundary_features.h.
#include "collision/shapes/boundary_features.h"

namespace twinarm {
namespace {

Patches of_cylinder(const Cylinder& c) {
  Patches patches;
  const Vector3 top(0, 0, c.length / 2);
  const Vector3 squares(c.radius * c.radius, c.radius * c.radius, 0);
  patches.flats = {Vector3::UnitZ(), -Vector3::UnitZ()};
  patches.ridges = {{-top, top, c.radius}};
  patches.rounds = {{top, Matrix3(squares.asDiagonal())}, {-top, Matrix3(squares.asDiagonal())}};
  return patches;
}

Patches of_ellipsoid(const Ellipsoid& e) {
  Patches patches;
  patches.rounds = {{Vector3::Zero(), Matrix3(e.semi_axes.cwiseAbs2().asDiagonal())}};
  return patches;
}

}  // namespace

Patches make_patches(const Shape& shape, const Polytope& core) {
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) return of_cylinder(*cylinder);
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&shape)) return of_ellipsoid(*ellipsoid);
  Patches patches;
  if (!core.exists) return patches;
  const std::vector<Vector3>& vertices = core.hull.vertices;
  patches.flats = core.hull.normals;
  for (const Polytope::Edge& edge : core.edges) {
    patches.ridges.push_back({vertices[edge.v0], vertices[edge.v1], 0});
  }
  for (const Vector3& v : vertices) patches.rounds.push_back({v, Matrix3::Zero()});
  patches.roundness = core.radius;
  return patches;
}

}  // namespace twinarm
