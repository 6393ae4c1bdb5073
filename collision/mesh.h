// A triangle mesh: closed and outward-oriented where it bounds a solid.
#pragma once

#include <array>
#include <vector>

#include "solver/pose.h"

namespace twinarm {

struct TriangleMesh {
  std::vector<Vector3> vertices;              // [m], in the frame of the link that owns it
  std::vector<std::array<int, 3>> triangles;  // counter-clockwise seen from outside
};

}  // namespace twinarm
