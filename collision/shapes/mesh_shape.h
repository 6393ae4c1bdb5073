// A triangle mesh that is collided with.
#pragma once

#include <string>

#include "collision/geometry/mass_properties.h"
#include "collision/geometry/mesh.h"

namespace twinarm {

struct MeshShape {
  static constexpr const char* name = "triangle mesh";
  TriangleMesh mesh;        // closed, outward; its inside is solid
  bool is_open = false;     // said to have borders: then touched from both sides
  double max_extent = 100;  // a wider mesh is taken for one in millimetres [m]

  Vector3 support(const Vector3& d) const { return max_along(mesh.vertices, d); }
  MassProperties solid(double density) const { return mass_properties(mesh, density); }
  // All that is wrong with it: empty, indices, not finite, degenerate triangles, the same ones
  // twice, open or flipped surface, millimetres. Empty text if nothing.
  std::string fault() const;
};

}  // namespace twinarm
