// A triangle mesh prepared for collision: triangles as flat polytopes, neighbours, bounding-volume
// hierarchy.
#pragma once

#include <array>
#include <vector>

#include "collision/narrow_phase/gjk.h"

namespace twinarm {

// Built by make_mesh_surface() (gjk.h) in O(n log n).
struct MeshSurface {
  struct Side {            // of a triangle, from vertex i to i + 1
    Vector3 outward;       // unit, in the plane of the triangle
    Vector3 of_neighbour;  // the neighbour's, or zero at a border
  };
  struct Node {  // of the hierarchy
    Aabb box;
    int first, count;           // range of `order`
    int left = -1, right = -1;  // -1: a leaf
  };
  std::vector<PreparedShape> triangles;
  std::vector<Vector3> normals;
  std::vector<std::array<Side, 3>> sides;
  std::vector<int> order;
  std::vector<Node> nodes;  // root first; empty for no triangles
  bool is_open = false;

  // Appends the triangles whose boxes overlap `box` (mesh frame), ascending.
  void find(const Aabb& box, std::vector<int>& found) const;
};

}  // namespace twinarm
