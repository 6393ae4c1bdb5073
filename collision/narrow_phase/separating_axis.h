// Direction of minimum overlap: of the face normals, and of two polytopes (separating axes).
#pragma once

#include <vector>

#include "collision/geometry/convex_hull.h"
#include "collision/narrow_phase/gjk.h"
#include "solver/spatial/pose.h"

namespace twinarm {

// Minimum over the normals of faces and caps. Keeps its arrays: a step does not allocate.
class FaceAxis {
 public:
  // Over all faces of both bodies; n stays zero without faces. False if one of them separates the
  // bodies by more than `margin`.
  bool best(const PosedShape& a, const PosedShape& b, double margin, PenetrationDirection& axis) {
    if (a.solid.core.exists && b.solid.core.exists) return best_of_polytopes(a, b, margin, axis);
    return try_flats(a, b, a, 1, margin, axis) && try_flats(a, b, b, -1, margin, axis);
  }

 private:
  bool try_flats(const PosedShape& a, const PosedShape& b, const PosedShape& own, double sign,
                 double margin, PenetrationDirection& axis);
  bool best_of_polytopes(const PosedShape& a, const PosedShape& b, double margin,
                         PenetrationDirection& axis);
  bool try_slabs(const Polytope& own, const Polytope& other, const Pose& X_own_other, double sign,
                 double margin, const Matrix3& R_W_own, double radii, PenetrationDirection& axis);

  std::vector<Vector3> vertices_;
  std::vector<double> bounds_;  // by face
};

// Minimum over all separating axes of two polytopes. Keeps its arrays: a step does not allocate.
class SeparatingAxis {
 public:
  // Improves `best` (any direction with its overlap, or the default) over all face normals of both
  // cores and all cross products of their edges; without radii. Only edges within `reach` of the
  // other core are tried (at least the depth or distance of the cores).
  void improve(const PosedShape& a, const PosedShape& b, double reach, PenetrationDirection& best);

 private:
  struct Posed {  // a core in W
    std::vector<Vector3> vertices, normals;
    std::vector<int> near_edges;
  };
  static void place(const PosedShape& body, Posed& posed);
  static void find_near_edges(const Polytope& core, const Posed& other, double reach, Posed& posed);
  static bool is_difference_face(const Polytope::Edge& ea, const Vector3& da,
                                 const Polytope::Edge& eb, const Vector3& db, const Posed& a,
                                 const Posed& b);
  void try_faces(const PosedShape& body, const Posed& own, const Posed& other, double sign,
                 PenetrationDirection& best) const;
  void try_edges(const Polytope& a, const Polytope& b, PenetrationDirection& best) const;
  double overlap_along(const Vector3& n_W) const;

  Posed a_, b_;
};

}  // namespace twinarm
