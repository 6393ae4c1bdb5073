// A triangle mesh: closed and outward-oriented where it bounds a solid.
#pragma once

#include <array>
#include <vector>

#include "solver/spatial/pose.h"

namespace twinarm {

struct TriangleMesh {
  std::vector<Vector3> vertices;              // [m], in the frame of the link that owns it
  std::vector<std::array<int, 3>> triangles;  // counter-clockwise seen from outside
};

// The first of the points that lie farthest along d (any length but zero).
Vector3 farthest_along(const std::vector<Vector3>& points, const Vector3& d);

// Each directed edge occurs once and its reverse occurs once: the surface has no border, and all
// triangles agree on which side is outside. O(n log n).
bool is_closed(const TriangleMesh& mesh);

}  // namespace twinarm
