// The contact points of one pair whose normal is known.
#pragma once

#include <vector>

#include "collision/narrow_phase/clip.h"
#include "collision/narrow_phase/gjk.h"

namespace twinarm {

constexpr int max_manifold_points = 4;

class Manifold {
 public:
  // The points where the features along the axis lie behind each other, whatever their depth.
  const std::vector<ManifoldPoint>& features(const PosedShape& a, const PosedShape& b,
                                             const PenetrationDirection& axis);
  // Finds them, and says whether they prove that no direction has less overlap.
  bool settles(const PosedShape& a, const PosedShape& b, const PenetrationDirection& axis);
  // After settles(): up to four of these points with depth > -margin.
  const std::vector<ManifoldPoint>& points(const PenetrationDirection& axis, double margin);

  // Up to four points along the given axis, with depth > -margin, the deepest among them.
  // `p_W` is a point between the surfaces where they are nearest: it is used where the features
  // have no common area (a rim, crossing edges, a corner).
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

// Keeps the four points that hold best: the deepest, the farthest from it, the one that spans the
// largest triangle with these, and the one farthest outside that triangle.
void reduce_to_four(const Vector3& n_W, std::vector<ManifoldPoint>& points);

}  // namespace twinarm
