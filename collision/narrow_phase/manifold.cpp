// Clip two support features, drop separated points, keep four. Cost 0.3-1 us; more for hull faces
// with many vertices.
#include "collision/narrow_phase/manifold.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace twinarm {
namespace {

constexpr double kRounding = 1e-12;   // [m]
constexpr double kOnePoint = 1e-6;    // closer deepest points are one point [m]
constexpr int kNearestPointName = 1;  // feature of the nearest point if no vertex is as deep

// Hysteresis of the choice: the same vertices are kept from step to step for a body at rest.
constexpr double kEqualDepth = 1e-8;  // [m]
constexpr double kEqualSize = 1e-6;   // of squared distances and areas, relative

// Moves the best of points[first..] to points[first]; the first of equal ones.
template <class Score>
void pick(std::vector<ManifoldPoint>& points, std::size_t first, Score score) {
  double highest = -1e300;
  for (std::size_t i = first; i < points.size(); ++i) highest = std::max(highest, score(points[i]));
  highest -= kEqualSize * std::abs(highest);
  const auto begin = points.begin() + static_cast<std::ptrdiff_t>(first);
  const auto best =
      std::find_if(begin, points.end(), [&](const auto& point) { return score(point) >= highest; });
  std::rotate(begin, best, best + 1);  // the others stay in order
}

}  // namespace

void reduce_to_four(const Vector3& n, std::vector<ManifoldPoint>& points) {
  if (points.size() <= kMaxManifoldPoints) return;
  // Of the deepest ones the outermost.
  double deepest = -1e300;
  Vector3 middle = Vector3::Zero();
  for (const ManifoldPoint& point : points) {
    deepest = std::max(deepest, point.depth);
    middle += point.p_WA / static_cast<double>(points.size());
  }
  pick(points, 0, [&](const ManifoldPoint& x) {
    return x.depth < deepest - kEqualDepth ? -1 : (x.p_WA - middle).squaredNorm();
  });
  const Vector3 p0 = points[0].p_WA;
  pick(points, 1, [&](const ManifoldPoint& x) { return (x.p_WA - p0).squaredNorm(); });
  const Vector3 p1 = points[1].p_WA;
  const auto area = [&](const Vector3& p, const Vector3& q, const Vector3& r) {
    return (q - p).cross(r - p).dot(n);
  };
  pick(points, 2, [&](const ManifoldPoint& x) { return std::abs(area(p0, p1, x.p_WA)); });
  const Vector3 p2 = points[2].p_WA;
  const double sign = area(p0, p1, p2) < 0 ? -1 : 1;
  pick(points, 3, [&](const ManifoldPoint& x) {
    return std::max(
        {-sign * area(p0, p1, x.p_WA), -sign * area(p1, p2, x.p_WA), -sign * area(p2, p0, x.p_WA)});
  });
  points.resize(kMaxManifoldPoints);
}

const std::vector<ManifoldPoint>& Manifold::features(const PosedShape& a, const PosedShape& b,
                                                     const PenetrationDirection& axis) {
  points_.clear();
  support_feature(a, axis.n_W, feature_a_);
  support_feature(b, -axis.n_W, feature_b_);
  intersect_features(feature_a_, feature_b_, axis.n_W, scratch_, clipped_, points_);
  return points_;
}

// Lower bound of the width of the contact polygon: twice the distance from its middle to the
// nearest side.
double Manifold::min_width(const Vector3& n_W) const {
  const std::size_t count = points_.size();
  if (count < 3) return 0;
  Vector3 middle = Vector3::Zero();
  for (const ManifoldPoint& point : points_) middle += point.p_WA;
  middle /= static_cast<double>(count);
  double min_distance = 1e300;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3& p = points_[i].p_WA;
    const Vector3 along = points_[i + 1 < count ? i + 1 : 0].p_WA - p;
    const double length = along.norm();
    if (!(length > 0)) continue;
    min_distance = std::min(min_distance, std::abs(n_W.dot(along.cross(middle - p))) / length);
  }
  return 2 * min_distance;
}

// Let d be the overlap along n, and D = A - B the Minkowski difference. No direction has a smaller
// overlap if D contains the ball of radius d about the origin.
// Separated cores: two points at the distance of the planes prove it.
// Overlapping: D contains x_i - x_j + depth_j n for all vertices i, j of the contact area. With its
// minimum width w and the range e of its depths, the support of D at an angle t from n is at least
// max(d cos t, w sin t + (d - e) cos t), which is less than d by at most d (e/w)^2 / 2, up to t =
// 90 deg. Beyond, by f: at least w cos f - d sin f; and from the far ends of the bodies, T behind
// and s sideways, T sin f - s cos f. One decreases, one increases: sufficient if both reach d at
// some f.
bool Manifold::certify_face_contact(const PosedShape& a, const PosedShape& b,
                                    const PenetrationDirection& axis) {
  features(a, b, axis);
  if (points_.empty()) return false;
  double deepest = -1e300, shallowest = 1e300;
  for (const ManifoldPoint& point : points_) {
    deepest = std::max(deepest, point.depth);
    shallowest = std::min(shallowest, point.depth);
  }
  const double d = axis.overlap, w = min_width(axis.n_W);
  if (deepest < d - kRounding) return false;
  if (d <= a.solid.core.radius + b.solid.core.radius) return true;
  const double slope = (d - shallowest) / w;
  if (!(w > d) || !(d * slope * slope < kRounding)) return false;
  const Vector3 back = a.support_W(-axis.n_W) - b.support_W(axis.n_W);
  const double T = -axis.n_W.dot(back), s = (back + T * axis.n_W).norm();
  const double cosine = std::min(0.7, 4 * d / w), sine = std::sqrt(1 - cosine * cosine);
  return w * cosine - d * sine >= d && T * sine - s * cosine >= d;
}

const std::vector<ManifoldPoint>& Manifold::points(const PenetrationDirection& axis,
                                                   double margin) {
  std::erase_if(points_, [&](const ManifoldPoint& x) { return !(x.depth > -margin); });
  reduce_to_four(axis.n_W, points_);
  return points_;
}

// Point midway between the surfaces at the nearest points: a vertex, a crossing of two lines, else
// p_W.
Vector3 Manifold::nearest_middle(const PenetrationDirection& axis, const Vector3& p_W) const {
  const Vector3 half = axis.n_W * (axis.overlap / 2);
  const std::vector<Vector3>&a = feature_a_.points, &b = feature_b_.points;
  if (a.size() == 1) return a[0] - half;
  if (b.size() == 1) return b[0] + half;
  if (a.size() != 2 || b.size() != 2) return p_W;
  const Vector3 u = a[1] - a[0], across = (b[1] - b[0]).cross(axis.n_W);
  const double denominator = u.dot(across);
  if (std::abs(denominator) < 1e-9 * u.norm() * across.norm()) return p_W;
  return a[0] + u * ((b[0] - a[0]).dot(across) / denominator) - half;
}

// Whether a face of either body has the normal n.
bool Manifold::has_face_normal(const Vector3& n_W) const {
  constexpr double cosine = 1 - 1e-12;
  return (feature_a_.is_polygon() && feature_a_.normal_W.dot(n_W) > cosine) ||
         (feature_b_.is_polygon() && feature_b_.normal_W.dot(n_W) < -cosine);
}

const std::vector<ManifoldPoint>& Manifold::between(const PosedShape& a, const PosedShape& b,
                                                    const PenetrationDirection& axis,
                                                    const Vector3& p_W, double margin) {
  features(a, b, axis);
  // The clipped vertices are the manifold only if one is as deep as the pair (a rim between two
  // vertices of its octagon is deeper). Without a face of this normal, a single deepest point is a
  // crossing or vertex on the border of the features; its labels depend on rounding, so it gets a
  // fixed feature and occurs once.
  const auto is_deepest = [&](const ManifoldPoint& x) { return x.depth > axis.overlap - 1e-10; };
  const auto first = std::find_if(points_.begin(), points_.end(), is_deepest);
  const bool found = first != points_.end();
  const Vector3 half = axis.n_W * (axis.overlap / 2);
  const Vector3 middle = found ? Vector3(first->p_WA - half) : nearest_middle(axis, p_W);
  const auto is_same = [&](const ManifoldPoint& x) {
    return is_deepest(x) && (x.p_WA - half - middle).norm() < kOnePoint;
  };
  const bool is_line = std::any_of(points_.begin(), points_.end(), [&](const ManifoldPoint& x) {
    return is_deepest(x) && !is_same(x);
  });
  if (!found || (!is_line && !has_face_normal(axis.n_W))) {
    std::erase_if(points_, is_same);
    points_.push_back({middle + half, middle - half, axis.overlap, kNearestPointName});
  }
  return points(axis, margin);
}

}  // namespace twinarm
