// Shapes as polytopes with a radius, which makes one exact narrow phase of most pairs:
//   sphere = point + r, capsule = segment + r, box and hull = polyhedron + 0,
// so that depth(A, B) = r_A + r_B - signed distance of the cores. Cylinders, ellipsoids:
// boundary_features.h.
#pragma once

#include <vector>

#include "collision/geometry/convex_hull.h"
#include "collision/geometry/support_vertices.h"

namespace twinarm {

struct Polytope {
  struct Edge {
    int v0, v1;  // its ends
    int f0, f1;  // the faces on both sides; -1 for a bare segment
  };
  struct Slab {  // a face, and the parallel one opposite if there is one
    Vector3 normal;
    double low, high;  // solid where low <= normal . x <= high [m]
    bool is_double;    // false: no face at `low`
  };
  ConvexHull hull;  // of a point or a segment: vertices only
  std::vector<Edge> edges;
  std::vector<Slab> slabs;
  double radius = 0;   // [m]
  bool exists = true;  // false for curved shapes and half-spaces
  VertexTable table;   // of the hull's vertices, where they are more than a few

  // The vertex that is farthest along d, in the body's frame.
  int farthest(const Vector3& d) const;
};

// With its edges and slabs.
Polytope polyhedron(ConvexHull hull);

// The box as a hull: 8 vertices, 6 faces.
ConvexHull box_hull(const Vector3& size);

}  // namespace twinarm
