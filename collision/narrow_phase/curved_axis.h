// Direction of minimum overlap if one of the bodies is a cylinder or an ellipsoid.
#pragma once

#include <vector>

#include "collision/narrow_phase/closed_forms.h"
#include "collision/narrow_phase/gjk.h"
#include "collision/narrow_phase/sphere_minimization.h"

namespace twinarm {

// Keeps its arrays: a step does not allocate.
class CurvedAxis {
 public:
  // False if the bodies are more than `margin` apart.
  bool nearest(const PosedShape& a, const PosedShape& b, double margin, NearestPair& pair);

 private:
  struct Posed {  // features in W, from the origin of A, that can be the optimum
    std::vector<BoundaryFeatures::Line> lines;
    std::vector<Vector3> along;  // by line, unit
    std::vector<BoundaryFeatures::Quadric> quadrics;
  };
  void pose_features(const PosedShape& body, const PosedShape& other, double reach, Posed& posed);
  void try_candidate(const Vector3& n_W, double min_gain);
  void try_quadric_direction(const Vector3& n_W, const BoundaryFeatures::Quadric& quadric,
                             bool is_of_a);
  double limit() const;
  void try_flats();
  void try_seeds();
  void try_feature_pairs(double reach);
  void try_line_pairs();
  void try_quadrics_on_lines(const Posed& quadrics, const Posed& lines, bool quadrics_are_a);
  void try_quadric_pairs();
  void search_sphere(const SupportSum& f, const BoundaryFeatures::Quadric& quadric, bool is_of_a);

  const PosedShape* body_a_ = nullptr;
  const PosedShape* body_b_ = nullptr;
  Vector3 origin_;
  bool overlaps_ = false, is_deep_ = false;
  NearestPair seed_, best_;
  Posed a_, b_;
  std::vector<Vector3> found_, vertices_;
  std::vector<double> bounds_;  // by face
};

}  // namespace twinarm
