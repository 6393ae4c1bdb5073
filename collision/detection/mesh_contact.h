// A triangle mesh against a convex body.
#pragma once

#include <vector>

#include "collision/detection/mesh_surface.h"
#include "collision/narrow_phase/clip.h"
#include "collision/narrow_phase/narrow_phase.h"

namespace twinarm {

class MeshContact {
 public:
  // Contacts with depth > -margin, each with its own normal, from the mesh (A) to the body (B). Of
  // a closed mesh only the sides that face the body's origin count: it is taken to be outside. Up
  // to four for each direction in which the body touches.
  const std::vector<ManifoldPoint>& contacts(NarrowPhase& narrow_phase, const PosedShape& mesh,
                                             const PosedShape& body, double margin);
  // Distance of the nearest triangle, or minus the largest depth [m].
  double distance(NarrowPhase& narrow_phase, const PosedShape& mesh, const PosedShape& body);

 private:
  void touch_triangle(NarrowPhase& narrow_phase, const PosedShape& mesh, int t,
                      const PosedShape& body, double margin);
  enum class Along { front, leaning };  // the triangle's own normal, or over a side or corner
  void take(const std::vector<ManifoldPoint>& points, Along along, const Vector3& n_W, int t,
            double margin);
  bool is_false(const PosedShape& mesh, const ManifoldPoint& point) const;
  void remove_ghost_contacts(const PosedShape& mesh);
  void reduce_contacts();

  struct Touch {  // of one triangle
    int triangle;
    Along along;
    double deepest;
    std::size_t first, last;  // of all_
  };

  Manifold manifold_;
  std::vector<int> near_;              // triangles
  std::vector<Touch> touches_, true_;  // true_: those that count, ascending in depth
  std::vector<ManifoldPoint> all_, group_, kept_;
};

}  // namespace twinarm
