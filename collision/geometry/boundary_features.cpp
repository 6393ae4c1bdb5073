// See boundary_features.h.
#include "collision/geometry/boundary_features.h"

namespace twinarm {
Patches make_patches(const Polytope& core) {
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
