// Contact manifold of a pair with known normal.
#pragma once

#include <vector>

#include "collision/narrow_phase/clip.h"
#include "collision/narrow_phase/gjk.h"

namespace twinarm {

constexpr int kMaxManifoldPoints = 4;

class Manifold {
 public:
  // Clipped support features along the axis, of any depth.
  const std::vector<ManifoldPoint>& features(const PosedShape& a, const PosedShape& b,
                                             const PenetrationDirection& axis);
  // Computes them; true if they prove that no direction has a smaller overlap.
  bool certify_face_contact(const PosedShape& a, const PosedShape& b,
                            const PenetrationDirection& axis);
  // After certify_face_contact(): at most four of these points, with depth > -margin.
  const std::vector<ManifoldPoint>& points(const PenetrationDirection& axis, double margin);

  // At most four points along the axis, with depth > -margin, including the deepest. `p_W`: point
  // midway between the surfaces at the deepest point, used if the features have no common area
  // (rim, crossing edges, vertex).
  const std::vector<ManifoldPoint>& between(const PosedShape& a, const PosedShape& b,
                                            const PenetrationDirection& axis, const Vector3& p_W,
                                            double margin);

 private:
  double min_width(const Vector3& n_W) const;
  bool has_face_normal(const Vector3& n_W) const;
  Vector3 nearest_middle(const PenetrationDirection& axis, const Vector3& p_W) const;

  Feature feature_a_, feature_b_, scratch_, clipped_;
  std::vector<ManifoldPoint> points_;
};

// Manifold reduction: keeps the deepest point, the farthest from it, the one that spans the largest
// triangle with these, and the one farthest outside that triangle.
void reduce_to_four(const Vector3& n_W, std::vector<ManifoldPoint>& points);

}  // namespace twinarm
