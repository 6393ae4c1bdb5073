// The direction of least overlap: the best of those known beforehand, and the exact one of two
// polytopes.
#pragma once

#include <vector>

#include "collision/geometry/convex_hull.h"
#include "collision/narrow_phase/gjk.h"
#include "solver/spatial/pose.h"

namespace twinarm {

// The best of the directions that are known beforehand: normals of faces and caps. Keeps its arrays
// from call to call, so that a step does not allocate.
class FlatAxis {
 public:
  // Least overlap among all flats of both bodies; n stays zero where there are none. False if one
  // of them parts the bodies by more than `margin`.
  bool best(const PosedShape& a, const PosedShape& b, double margin, PenetrationDirection& axis);

 private:
  bool try_flats(const PosedShape& a, const PosedShape& b, const PosedShape& own, double sign,
                 double margin, PenetrationDirection& axis);
  bool best_of_polytopes(const PosedShape& a, const PosedShape& b, double margin,
                         PenetrationDirection& axis);
  bool try_slabs(const Polytope& own, const Polytope& other, const Pose& X_own_other, double sign,
                 double margin, const Matrix3& R_W_own, double radii, PenetrationDirection& axis);

  std::vector<Vector3> vertices_;
  std::vector<double> bounds_;  // by flat
};

// The exact direction of least overlap of two polytopes. Keeps its arrays from call to call, so
// that a step does not allocate.
class SeparatingAxis {
 public:
  // Improves `best` (any known direction with its overlap, or the default) to the direction of
  // least overlap among all face normals of both cores and all cross products of their edges. Radii
  // are left out. Only edges within `reach` of the other core are tried: at least the depth or the
  // distance of the cores.
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
