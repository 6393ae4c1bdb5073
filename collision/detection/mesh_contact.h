// Contacts of a triangle mesh with a convex body.
#pragma once

#include <vector>

#include "collision/detection/mesh_surface.h"
#include "collision/narrow_phase/clip.h"
#include "collision/narrow_phase/narrow_phase.h"

namespace twinarm {

class MeshContact {
 public:
  // Contacts with depth > -margin, each with its own normal, from the mesh (A) to the body (B); up
  // to four for each normal. Of a closed mesh only triangles that face the body's origin count.
  const std::vector<ManifoldPoint>& contacts(NarrowPhase& narrow_phase, const PosedShape& mesh,
                                             const PosedShape& body, double margin);
  // Distance of the nearest triangle, or minus the largest depth [m].
  double distance(NarrowPhase& narrow_phase, const PosedShape& mesh, const PosedShape& body);

 private:
  void collide_triangle(NarrowPhase& narrow_phase, const PosedShape& mesh, int t,
                        const PosedShape& body, double margin);
  enum class NormalKind { face, edge };  // the triangle's normal, or that of an edge or vertex
  void add_points(const std::vector<ManifoldPoint>& points, NormalKind along, const Vector3& n_W,
                  int t, double margin);
  bool is_ghost(const PosedShape& mesh, const ManifoldPoint& point) const;
  void remove_ghost_contacts(const PosedShape& mesh);
  void reduce_contacts();

  struct TriangleContact {
    int triangle;
    NormalKind along;
    double deepest;
    std::size_t first, last;  // range of all_
  };

  Manifold manifold_;
  std::vector<int> near_;  // triangles
  std::vector<TriangleContact> triangle_contacts_,
      accepted_;  // accepted_: no ghosts, ascending in depth
  std::vector<ManifoldPoint> all_, group_, kept_;
};

}  // namespace twinarm
