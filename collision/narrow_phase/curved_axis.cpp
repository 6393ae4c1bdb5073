// Minimum overlap of a cylinder or ellipsoid with another convex body, by enumeration of pairs of
// boundary features (convex_hull.h), each with its support function:
//   face with anything       the normal is known
//   line with line           n is perpendicular to both
//   line with quadric        n is perpendicular to the line: one angle, minimise_on_circle()
//   quadric with quadric     two unknown angles, minimise_on_sphere()
// Every direction is evaluated by overlap(n) of the whole bodies, an upper bound of the depth.
// Pairs of features are skipped by two bounds: the touching points are as far apart as the depth or
// distance; and along n the bodies overlap by at least as much as two of their features. For
// separated bodies the distance is known (gjk.h) and f is convex. For overlapping bodies f can have
// several minima on the sphere; the search starts from all axes and keeps the best few. Cost of a
// contact: 5-30 us; with a hull of 100 edges up to 0.2 ms.
#include "collision/narrow_phase/curved_axis.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace twinarm {
namespace {

constexpr double kFacePreference = 1e-12;  // bias towards face normals [m]
constexpr double kMissed = 1e-8;           // tolerance of the first estimate [m]
constexpr double kParallel = 1e-9;         // sine below which two lines have no common normal
constexpr double kSameMinimum = 0.95, kSameMinimumDeep = 0.999;  // cosines
constexpr int kShallowSearches = 4, kDeepSearches = 18;          // descents
constexpr double kDeepShare = 0.02;

// The support function of a cylinder's rim has a kink in the direction of the axis, which can hide
// minima next to it: also start around the axis, and between two axes.
void add_starts_around_kinks(const PosedShape& a, const PosedShape& b, Starts& starts) {
  constexpr double kAside = 0.12;  // [rad]
  bool any = false;
  for (const PosedShape* body : {&a, &b}) {
    if (body->solid.core.exists || body->solid.boundary.face_normals.empty()) continue;
    any = true;
    for (int k = 0; k < 12; ++k) {
      const double angle = std::numbers::pi / 3 * k, side = k < 6 ? 1 : -1;
      starts.add(body->X_WG.R * Vector3(kAside * std::cos(angle), kAside * std::sin(angle), side));
    }
  }
  if (!any) return;
  const Vector3 z_a = a.X_WG.R.col(2), z_b = b.X_WG.R.col(2);
  for (const Vector3& between : {Vector3(z_a + z_b), Vector3(z_a - z_b)}) {
    starts.add(between);
    starts.add(-between);
  }
}

}  // namespace

// Edges of a polytope share vertices; a vertex has Q = 0.
void CurvedAxis::pose_features(const PosedShape& body, const PosedShape& other, double reach,
                               Posed& posed) {
  const BoundaryFeatures& boundary = body.solid.boundary;
  const Polytope& core = body.solid.core;
  const Aabb range = bounding_box(other, reach);
  posed.lines.clear();
  posed.along.clear();
  posed.quadrics.clear();
  vertices_.clear();
  for (const BoundaryFeatures::Quadric& quadric : boundary.quadrics) {
    const Vector3 p = vertices_.emplace_back(body.X_WG * quadric.p);
    const Matrix3& R = body.X_WG.R;
    const Matrix3 Q = core.exists ? quadric.Q : Matrix3(R * quadric.Q * R.transpose());
    const Vector3 half = Q.diagonal().cwiseMax(0).cwiseSqrt();
    if (range.intersects(Aabb(p - half, p + half))) posed.quadrics.push_back({p - origin_, Q});
  }
  for (std::size_t k = 0; k < boundary.lines.size(); ++k) {
    const BoundaryFeatures::Line& line = boundary.lines[k];
    const Vector3 p = core.exists ? vertices_[core.edges[k].v0] : body.X_WG * line.start;
    const Vector3 q = core.exists ? vertices_[core.edges[k].v1] : body.X_WG * line.end;
    const Vector3 r = Vector3::Constant(line.radius);
    if (!range.intersects(Aabb(p.cwiseMin(q) - r, p.cwiseMax(q) + r))) continue;
    posed.lines.push_back({p - origin_, q - origin_, line.radius});
    posed.along.push_back((q - p).normalized());
  }
}

// n_W of any length; the point is the mean of the two support points.
void CurvedAxis::try_candidate(const Vector3& n_W, double min_gain) {
  PenetrationDirection axis = best_.axis;
  try_direction(*body_a_, *body_b_, n_W, min_gain, axis);
  if (axis.overlap == best_.axis.overlap) return;
  best_ = {axis, mean_of_supports(*body_a_, *body_b_, axis.n_W)};
}

// As try_candidate(), with the contact point on `quadric`.
void CurvedAxis::try_quadric_direction(const Vector3& n_W, const BoundaryFeatures::Quadric& quadric,
                                       bool is_of_a) {
  const double before = best_.axis.overlap;
  try_candidate(n_W, kFacePreference);
  if (best_.axis.overlap == before) return;
  const Vector3& n = best_.axis.n_W;
  const double side = is_of_a ? 1 : -1;
  const Vector3 Qn = quadric.Q * (side * n);
  const double height = std::sqrt(std::max(0.0, side * n.dot(Qn)));
  Vector3 p = origin_ + quadric.p;
  if (height > 0) p += Qn / height;
  p += side * (is_of_a ? *body_a_ : *body_b_).solid.boundary.rounding_radius * n;
  best_.p_W = p - side * (best_.axis.overlap / 2) * n;
}

// Directions with an overlap above this cannot be the result.
double CurvedAxis::limit() const {
  return std::min(best_.axis.overlap, seed_.axis.overlap + kMissed);
}

void CurvedAxis::try_flats() {
  const auto try_of = [&](const PosedShape& body, const PosedShape& other, double sign) {
    const std::vector<Vector3>& face_normals = body.solid.boundary.face_normals;
    const std::size_t first = face_depth_lower_bounds(body, other, bounds_);
    for (std::size_t k = 0; k < face_normals.size(); ++k) {
      const std::size_t f = (first + k) % face_normals.size();
      if (bounds_[f] > limit()) continue;
      const Vector3 out = body.X_WG.R * face_normals[f], n = sign * out;
      if (face_depth_lower_bound(body, f, out, other) > limit()) continue;
      const double before = best_.axis.overlap;
      try_candidate(n, 0);
      if (best_.axis.overlap == before) continue;
      // Contact point: support point of the other body.
      best_.p_W = other.support_W(-sign * n) + n * (sign * 0.5 * best_.axis.overlap);
    }
  };
  try_of(*body_a_, *body_b_, 1);
  try_of(*body_b_, *body_a_, -1);
}

// Directions that bound the depth before the search.
void CurvedAxis::try_seeds() {
  try_candidate(body_b_->X_WG.p - body_a_->X_WG.p, 0);
  for (int i = 0; i < 3; ++i)
    for (const double sign : {1.0, -1.0}) {
      try_candidate(sign * body_a_->X_WG.R.col(i), 0);
      try_candidate(sign * body_b_->X_WG.R.col(i), 0);
    }
}

void CurvedAxis::try_line_pairs() {
  for (std::size_t i = 0; i < a_.lines.size(); ++i)
    for (std::size_t j = 0; j < b_.lines.size(); ++j) {
      const BoundaryFeatures::Line &ra = a_.lines[i], &rb = b_.lines[j];
      const Vector3 between = rb.start - ra.start;
      Vector3 n = a_.along[i].cross(b_.along[j]);
      const bool are_parallel = n.norm() < kParallel;
      if (are_parallel) n = between - a_.along[i] * a_.along[i].dot(between);
      const double length = n.norm(), radii = ra.radius + rb.radius;  // n is perpendicular to both
      for (const double sign : {1.0, -1.0}) {
        const double before = best_.axis.overlap;
        if (radii * length - sign * n.dot(between) >= limit() * length) continue;
        try_candidate(sign * n, kFacePreference);
        if (best_.axis.overlap == before || are_parallel) continue;
        // Point at which the two lines cross in the projection along n.
        const Vector3 across = b_.along[j].cross(n);
        const double s = between.dot(across) / a_.along[i].dot(across);
        const Vector3 p_a = ra.start + s * a_.along[i] + origin_;
        best_.p_W = midway(*body_a_, *body_b_, best_.axis.n_W, p_a);
      }
    }
}

void CurvedAxis::try_quadrics_on_lines(const Posed& quadrics, const Posed& lines,
                                       bool quadrics_are_a) {
  const double side = quadrics_are_a ? 1 : -1;
  for (const BoundaryFeatures::Quadric& quadric : quadrics.quadrics)
    for (std::size_t j = 0; j < lines.lines.size(); ++j) {
      const Vector3 c = side * (quadric.p - lines.lines[j].start);
      found_.clear();
      const SupportSum f{c, quadric.Q, Matrix3::Zero()};
      minimise_on_circle(f, lines.along[j], is_deep_, found_);
      for (const Vector3& n : found_)
        if (f(n) + lines.lines[j].radius < limit())
          try_quadric_direction(n, quadric, quadrics_are_a);
    }
}

void CurvedAxis::search_sphere(const SupportSum& f, const BoundaryFeatures::Quadric& quadric,
                               bool is_of_a) {
  const auto descend = [&](const Vector3& start) {
    const Vector3 n = minimise_on_sphere(f, start);
    if (f(n) < limit()) try_quadric_direction(n, quadric, is_of_a);
  };
  if (!overlaps_) return descend(seed_.axis.n_W);
  Starts starts;
  starts.add_axes(body_a_->X_WG.R);
  starts.add_axes(body_b_->X_WG.R);
  if (is_deep_) add_starts_around_kinks(*body_a_, *body_b_, starts);
  if (f.c.norm() > 0) starts.add(-f.c);
  starts.add(seed_.axis.n_W);
  const auto end = starts.n.begin() + static_cast<std::ptrdiff_t>(starts.count);
  std::sort(starts.n.begin(), end, [&](const auto& x, const auto& y) { return f(x) < f(y); });
  std::array<Vector3, kDeepSearches> used;
  int searches = 0;
  for (auto start = starts.n.begin();
       start != end && searches < (is_deep_ ? kDeepSearches : kShallowSearches); ++start) {
    const bool known = std::any_of(used.begin(), used.begin() + searches, [&](const Vector3& n) {
      return n.dot(*start) > (is_deep_ ? kSameMinimumDeep : kSameMinimum);
    });
    if (known) continue;
    used[static_cast<std::size_t>(searches++)] = *start;
    descend(*start);
  }
}

void CurvedAxis::try_quadric_pairs() {
  for (const BoundaryFeatures::Quadric& quadric_a : a_.quadrics)
    for (const BoundaryFeatures::Quadric& quadric_b : b_.quadrics) {
      const SupportSum f{quadric_a.p - quadric_b.p, quadric_a.Q, quadric_b.Q};
      const bool a_is_corner = quadric_a.Q.isZero(0);
      search_sphere(f, a_is_corner ? quadric_b : quadric_a, !a_is_corner);
    }
}

void CurvedAxis::try_feature_pairs(double reach) {
  pose_features(*body_a_, *body_b_, reach, a_);
  pose_features(*body_b_, *body_a_, reach, b_);
  try_line_pairs();
  try_quadrics_on_lines(a_, b_, true);
  try_quadrics_on_lines(b_, a_, false);
  try_quadric_pairs();
}

bool CurvedAxis::nearest(const PosedShape& a, const PosedShape& b, double margin,
                         NearestPair& pair) {
  body_a_ = &a;
  body_b_ = &b;
  origin_ = a.X_WG.p;
  best_ = {};
  const double radii = a.solid.boundary.rounding_radius + b.solid.boundary.rounding_radius;
  const CoreDistance cores = core_distance(a, b, margin + radii);
  overlaps_ = !(cores.distance > kMinGjkDistance);
  if (!overlaps_) {
    try_candidate(cores.n_W, 0);
    if (best_.axis.overlap < -margin) return false;
    best_.p_W = midway(a, b, best_.axis.n_W, 0.5 * (cores.p_WA + cores.p_WB));
    overlaps_ = has_duality_gap(cores.distance, best_.axis.overlap - radii);
  }
  if (overlaps_) try_seeds();
  seed_ = best_;
  best_ = {};
  try_flats();
  double reach = cores.distance + kMinGjkDistance;
  if (overlaps_) reach = std::max(reach, std::min(seed_.axis.overlap, best_.axis.overlap) - radii);
  is_deep_ = false;
  try_feature_pairs(reach * (1 + 1e-6) + 1e-9);
  // Beyond a share of the minimum radius of curvature minima can lie close together: refine, now
  // that the depth is nearly known and fewer features remain.
  const double depth = std::min(seed_.axis.overlap, best_.axis.overlap) - radii;
  is_deep_ = overlaps_ && depth > kDeepShare * std::min(a.solid.boundary.min_radius,
                                                        b.solid.boundary.min_radius);
  if (is_deep_) try_feature_pairs(depth * (1 + 1e-6) + 1e-9);
  // The first estimate is less accurate; used only if the enumeration missed the minimum.
  if (seed_.axis.overlap < best_.axis.overlap - kMissed) best_ = seed_;
  pair = best_;
  return best_.axis.overlap > -margin;
}

}  // namespace twinarm
