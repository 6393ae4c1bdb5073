// A triangle mesh as a collision shape.
#pragma once

#include <string>

#include "collision/geometry/mass_properties.h"
#include "collision/geometry/mesh.h"

namespace twinarm {

struct MeshShape {
  static constexpr const char* name = "triangle mesh";
  TriangleMesh mesh;        // closed, outward orientation, solid inside
  bool is_open = false;     // declared as open: contacts from both sides
  double max_extent = 100;  // a wider mesh is probably in millimetres [m]

  Vector3 support(const Vector3& d) const { return support_point(mesh.vertices, d); }
  MassProperties solid(double density) const { return mass_properties(mesh, density); }
  // All errors: empty, invalid indices, not finite, degenerate or duplicate triangles, open or
  // inverted surface, millimetres. Empty if valid.
  std::string fault() const;
};

}  // namespace twinarm
