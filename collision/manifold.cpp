// From two support features to a contact manifold: clip, drop what is apart, keep four.
// A pure function of the poses. Cost 0.3-1 us; hull faces with many corners more.
#include "collision/manifold.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace twinarm {
namespace {

constexpr int witness_name = 1;  // of the nearest point, where no corner is as deep

// Moves the best of points[first..] to points[first]. Equal ones: the first stays.
template <class Score>
void pick(std::vector<ManifoldPoint>& points, std::size_t first, Score score) {
  std::size_t best = first;
  for (std::size_t i = first + 1; i < points.size(); ++i) {
    if (score(points[i]) > score(points[best]) + 1e-12) best = i;
  }
  std::swap(points[first], points[best]);
}

}  // namespace

void reduce_to_four(const Vector3& n, std::vector<ManifoldPoint>& points) {
  if (points.size() <= max_manifold_points) return;
  pick(points, 0, [](const ManifoldPoint& x) { return x.depth; });
  const Vector3 p0 = points[0].p_WA;
  pick(points, 1, [&](const ManifoldPoint& x) { return (x.p_WA - p0).squaredNorm(); });
  const Vector3 p1 = points[1].p_WA;
  const auto area = [&](const Vector3& p, const Vector3& q, const Vector3& r) {
    return (q - p).cross(r - p).dot(n);
  };
  pick(points, 2, [&](const ManifoldPoint& x) { return std::abs(area(p0, p1, x.p_WA)); });
  const Vector3 p2 = points[2].p_WA;
  const double turn = area(p0, p1, p2) < 0 ? -1 : 1;
  pick(points, 3, [&](const ManifoldPoint& x) {
    return std::max(
        {-turn * area(p0, p1, x.p_WA), -turn * area(p1, p2, x.p_WA), -turn * area(p2, p0, x.p_WA)});
  });
  points.resize(max_manifold_points);
}

const std::vector<ManifoldPoint>& Manifold::between(const Placed& a, const Placed& b,
                                                    const Axis& axis, const Vector3& p_W,
                                                    double margin) {
  points_.clear();
  support_feature(a, axis.n_W, feature_a_);
  support_feature(b, -axis.n_W, feature_b_);
  intersect_features(feature_a_, feature_b_, axis.n_W, scratch_, clipped_, points_);
  // The clipped corners are the contact only if one of them is as deep as the pair is; a rim
  // between two corners of its octagon, for one, is deeper.
  double deepest = -1e300;
  for (const ManifoldPoint& point : points_) deepest = std::max(deepest, point.depth);
  if (deepest < axis.overlap - 1e-10) {
    const Vector3 half = axis.n_W * (axis.overlap / 2);
    points_.push_back({p_W + half, p_W - half, axis.overlap, witness_name});
  }
  std::erase_if(points_, [&](const ManifoldPoint& x) { return !(x.depth > -margin); });
  reduce_to_four(axis.n_W, points_);
  return points_;
}

}  // namespace twinarm
