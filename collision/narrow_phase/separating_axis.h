// The exact direction of least overlap of two polytopes.
#pragma once

#include <vector>

#include "collision/geometry/polytope.h"
#include "collision/narrow_phase/posed_shape.h"
#include "solver/spatial/pose.h"

namespace twinarm {

// Keeps its arrays from call to call, so that a step does not allocate.
class SeparatingAxis {
 public:
  // Improves `best` (any known direction with its overlap, or the default) to the direction of
  // least overlap among all face normals of both cores and all cross products of their edges. Radii
  // are left out. Only edges within `reach` of the other core are tried: at least the depth or the
  // distance of the cores.
  void improve(const Placed& a, const Placed& b, double reach, Axis& best);

 private:
  struct Posed {  // a core in W
    std::vector<Vector3> vertices, normals;
    std::vector<int> near_edges;
  };
  static void place(const Placed& body, Posed& posed);
  static void find_near_edges(const Polytope& core, const Posed& other, double reach, Posed& posed);
  static bool is_difference_face(const Polytope::Edge& ea, const Vector3& da,
                                 const Polytope::Edge& eb, const Vector3& db, const Posed& a,
                                 const Posed& b);
  void try_faces(const Placed& body, const Posed& own, const Posed& other, double sign,
                 Axis& best) const;
  void try_edges(const Polytope& a, const Polytope& b, Axis& best) const;
  double overlap_along(const Vector3& n_W) const;

  Posed a_, b_;
};

}  // namespace twinarm
