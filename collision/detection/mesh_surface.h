// A triangle mesh as a collision shape: its triangles as thin polytopes, their neighbours, and a
// tree of their boxes.
#pragma once

#include <array>
#include <vector>

#include "collision/narrow_phase/gjk.h"
#include "collision/shapes/aabb.h"

namespace twinarm {

// Made by make_mesh_surface() (gjk.h), in O(n log n).
struct MeshSurface {
  struct Side {            // of a triangle, from corner i to i + 1
    Vector3 outward;       // unit, in the plane of the triangle
    Vector3 of_neighbour;  // the same of the triangle beyond, or zero at a border
  };
  struct Node {  // of the tree
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

  // Appends the triangles whose boxes meet `box` (in the frame of the mesh), ascending.
  void find(const Aabb& box, std::vector<int>& found) const;
};

}  // namespace twinarm
