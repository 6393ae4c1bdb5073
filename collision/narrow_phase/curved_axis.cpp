// Least overlap of a cylinder or an ellipsoid and another convex body, by enumeration of patches.
//
// The plane of least overlap touches both bodies, each with a flat, a ridge or a round
// (convex_hull.h):
//   flat with anything     the normal is known;
//   ridge with ridge       n across both lines;
//   ridge with round       n across the line: one angle is free, minimise_on_circle();
//   round with round       two angles are free, minimise_on_sphere().
// Every direction found is judged by overlap(n) of the whole bodies, an upper bound of the depth
// for any n; a pair of patches that does not face n loses there. What cannot carry the optimum is
// left out first: the two touching points are as far apart as the depth or the distance is; and
// along any n the bodies overlap by no less than two of their patches do, which is one line where
// overlap(n) asks all corners. For bodies that are apart that distance is known (gjk.h), and f is
// convex. For overlapping ones f may have several minima on the sphere; the search starts from all
// axes and keeps the best few. Cost where bodies touch: 5-30 us, with a hull of 100 edges up to 0.2
// ms.
#include "collision/narrow_phase/curved_axis.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "collision/narrow_phase/gjk.h"

namespace twinarm {
namespace {

constexpr double prefer_flat = 1e-12;  // a flat wins over a direction this much better [m]
constexpr double missed = 1e-8;        // a guess this much better shows a patch overlooked [m]
constexpr double parallel = 1e-9;      // sine below which two lines have no common normal
constexpr double same_valley = 0.95, same_valley_deep = 0.999;  // cosines
constexpr int shallow_searches = 4, deep_searches = 18;         // valleys that are followed
constexpr double deep_share = 0.02;

struct Range {
  Vector3 low, high;
};

Range range_of(const PosedShape& body, double reach) {
  Range range;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 e = Vector3::Unit(axis);
    range.high[axis] = body.support_W(e)[axis] + reach;
    range.low[axis] = body.support_W(-e)[axis] - reach;
  }
  return range;
}

bool meets(const Range& range, const Vector3& low, const Vector3& high) {
  return (low.array() <= range.high.array()).all() && (high.array() >= range.low.array()).all();
}

// Along the axis of a cylinder the height of its rim has a kink, which may be a minimum and hide
// others next to it: begin round it as well, and between two of them.
void add_round_kinks(const PosedShape& a, const PosedShape& b, Starts& starts) {
  constexpr double aside = 0.12;  // [rad]
  bool any = false;
  for (const PosedShape* body : {&a, &b}) {
    if (body->solid.core.exists || body->solid.patches.flats.empty()) continue;
    any = true;
    for (int k = 0; k < 12; ++k) {
      const double angle = std::numbers::pi / 3 * k, side = k < 6 ? 1 : -1;
      starts.add(body->X_WG.R * Vector3(aside * std::cos(angle), aside * std::sin(angle), side));
    }
  }
  if (!any) return;
  const Vector3 z_a = a.X_WG.R.col(2), z_b = b.X_WG.R.col(2);
  for (const Vector3& between : {Vector3(z_a + z_b), Vector3(z_a - z_b)}) {
    starts.add(between);
    starts.add(-between);
  }
}

Matrix3 turned(const Matrix3& R, const Matrix3& Q) {
  return R * Q * R.transpose();
}

}  // namespace

// Edges of a polytope share corners, and a corner has no Q to turn.
void CurvedAxis::place(const PosedShape& body, const PosedShape& other, double reach,
                       Posed& posed) {
  const Patches& patches = body.solid.patches;
  const Polytope& core = body.solid.core;
  const Range range = range_of(other, reach);
  posed.ridges.clear();
  posed.along.clear();
  posed.rounds.clear();
  corners_.clear();
  for (const Patches::Round& round : patches.rounds) {
    const Vector3 p = corners_.emplace_back(body.X_WG * round.p);
    const Matrix3 Q = core.exists ? round.Q : turned(body.X_WG.R, round.Q);
    const Vector3 half = Q.diagonal().cwiseMax(0).cwiseSqrt();
    if (meets(range, p - half, p + half)) posed.rounds.push_back({p - origin_, Q});
  }
  for (std::size_t k = 0; k < patches.ridges.size(); ++k) {
    const Patches::Ridge& ridge = patches.ridges[k];
    const Vector3 p = core.exists ? corners_[core.edges[k].v0] : body.X_WG * ridge.start;
    const Vector3 q = core.exists ? corners_[core.edges[k].v1] : body.X_WG * ridge.end;
    const Vector3 r = Vector3::Constant(ridge.radius);
    if (!meets(range, p.cwiseMin(q) - r, p.cwiseMax(q) + r)) continue;
    posed.ridges.push_back({p - origin_, q - origin_, ridge.radius});
    posed.along.push_back((q - p).normalized());
  }
}

// A direction of any length; the middle is that of the two supports.
void CurvedAxis::offer(const Vector3& n_W, double handicap) {
  PenetrationDirection axis = best_.axis;
  consider(*body_a_, *body_b_, n_W, handicap, axis);
  if (axis.overlap == best_.axis.overlap) return;
  best_ = {axis, mean_of_supports(*body_a_, *body_b_, axis.n_W)};
}

// A direction in which `round` supports its body: there the bodies touch.
void CurvedAxis::offer_round(const Vector3& n_W, const Patches::Round& round, bool is_of_a) {
  const double before = best_.axis.overlap;
  offer(n_W, prefer_flat);
  if (best_.axis.overlap == before) return;
  const Vector3& n = best_.axis.n_W;
  const double side = is_of_a ? 1 : -1;
  const Vector3 Qn = round.Q * (side * n);
  const double height = std::sqrt(std::max(0.0, side * n.dot(Qn)));
  Vector3 p = origin_ + round.p;
  if (height > 0) p += Qn / height;
  p += side * (is_of_a ? *body_a_ : *body_b_).solid.patches.roundness * n;
  best_.p_W = p - side * (best_.axis.overlap / 2) * n;
}

// Of this overlap on, a direction does not count in the end.
double CurvedAxis::limit() const {
  return std::min(best_.axis.overlap, seed_.axis.overlap + missed);
}

void CurvedAxis::try_flats() {
  const auto try_of = [&](const PosedShape& body, const PosedShape& other, double sign) {
    const std::vector<Vector3>& flats = body.solid.patches.flats;
    const std::size_t first = face_depth_lower_bounds(body, other, bounds_);
    for (std::size_t k = 0; k < flats.size(); ++k) {
      const std::size_t f = (first + k) % flats.size();
      if (bounds_[f] > limit()) continue;
      const Vector3 out = body.X_WG.R * flats[f], n = sign * out;
      if (bound_flat(body, f, out, other) > limit()) continue;
      const double before = best_.axis.overlap;
      offer(n, 0);
      if (best_.axis.overlap == before) continue;
      // The point is where the other body is nearest: a flat has no best point of its own.
      best_.p_W = other.support_W(-sign * n) + n * (sign * 0.5 * best_.axis.overlap);
    }
  };
  try_of(*body_a_, *body_b_, 1);
  try_of(*body_b_, *body_a_, -1);
}

// Directions that bound the depth before anything is searched.
void CurvedAxis::try_seeds() {
  offer(body_b_->X_WG.p - body_a_->X_WG.p, 0);
  for (int i = 0; i < 3; ++i) {
    for (const double sign : {1.0, -1.0}) {
      offer(sign * body_a_->X_WG.R.col(i), 0);
      offer(sign * body_b_->X_WG.R.col(i), 0);
    }
  }
}

void CurvedAxis::try_ridges() {
  for (std::size_t i = 0; i < a_.ridges.size(); ++i) {
    for (std::size_t j = 0; j < b_.ridges.size(); ++j) {
      const Patches::Ridge &ra = a_.ridges[i], &rb = b_.ridges[j];
      const Vector3 between = rb.start - ra.start;
      Vector3 n = a_.along[i].cross(b_.along[j]);
      const bool are_parallel = n.norm() < parallel;
      if (are_parallel) n = between - a_.along[i] * a_.along[i].dot(between);
      const double length = n.norm(), radii = ra.radius + rb.radius;  // n is across both
      for (const double sign : {1.0, -1.0}) {
        const double before = best_.axis.overlap;
        if (radii * length - sign * n.dot(between) >= limit() * length) continue;
        offer(sign * n, prefer_flat);
        if (best_.axis.overlap == before || are_parallel) continue;
        // Where the two lines cross, seen along n.
        const Vector3 across = b_.along[j].cross(n);
        const double s = between.dot(across) / a_.along[i].dot(across);
        const Vector3 p_a = ra.start + s * a_.along[i] + origin_;
        best_.p_W = midway(*body_a_, *body_b_, best_.axis.n_W, p_a);
      }
    }
  }
}

void CurvedAxis::try_rounds_on_ridges(const Posed& rounds, const Posed& ridges, bool rounds_are_a) {
  const double side = rounds_are_a ? 1 : -1;
  for (const Patches::Round& round : rounds.rounds) {
    for (std::size_t j = 0; j < ridges.ridges.size(); ++j) {
      const Vector3 c = side * (round.p - ridges.ridges[j].start);
      found_.clear();
      const SupportSum f{c, round.Q, Matrix3::Zero()};
      minimise_on_circle(f, ridges.along[j], is_deep_, found_);
      for (const Vector3& n : found_) {
        if (f(n) + ridges.ridges[j].radius < limit()) offer_round(n, round, rounds_are_a);
      }
    }
  }
}

void CurvedAxis::search_sphere(const SupportSum& f, const Patches::Round& round, bool is_of_a) {
  const auto descend = [&](const Vector3& start) {
    const Vector3 n = minimise_on_sphere(f, start);
    if (f(n) < limit()) offer_round(n, round, is_of_a);
  };
  if (!overlaps_) return descend(seed_.axis.n_W);
  Starts starts;
  starts.add_axes(body_a_->X_WG.R);
  starts.add_axes(body_b_->X_WG.R);
  if (is_deep_) add_round_kinks(*body_a_, *body_b_, starts);
  if (f.c.norm() > 0) starts.add(-f.c);
  starts.add(seed_.axis.n_W);
  const auto end = starts.n.begin() + static_cast<std::ptrdiff_t>(starts.count);
  std::sort(starts.n.begin(), end, [&](const auto& x, const auto& y) { return f(x) < f(y); });
  std::array<Vector3, deep_searches> used;
  int searches = 0;
  for (auto start = starts.n.begin();
       start != end && searches < (is_deep_ ? deep_searches : shallow_searches); ++start) {
    const bool known = std::any_of(used.begin(), used.begin() + searches, [&](const Vector3& n) {
      return n.dot(*start) > (is_deep_ ? same_valley_deep : same_valley);
    });
    if (known) continue;
    used[static_cast<std::size_t>(searches++)] = *start;
    descend(*start);
  }
}

void CurvedAxis::try_rounds() {
  for (const Patches::Round& round_a : a_.rounds) {
    for (const Patches::Round& round_b : b_.rounds) {
      const SupportSum f{round_a.p - round_b.p, round_a.Q, round_b.Q};
      const bool a_is_corner = round_a.Q.isZero(0);
      search_sphere(f, a_is_corner ? round_b : round_a, !a_is_corner);
    }
  }
}

void CurvedAxis::try_patches(double reach) {
  place(*body_a_, *body_b_, reach, a_);
  place(*body_b_, *body_a_, reach, b_);
  try_ridges();
  try_rounds_on_ridges(a_, b_, true);
  try_rounds_on_ridges(b_, a_, false);
  try_rounds();
}

bool CurvedAxis::nearest(const PosedShape& a, const PosedShape& b, double margin,
                         NearestPair& pair) {
  body_a_ = &a;
  body_b_ = &b;
  origin_ = a.X_WG.p;
  best_ = {};
  const double radii = a.solid.patches.roundness + b.solid.patches.roundness;
  const CoreDistance cores = core_distance(a, b, margin + radii);
  overlaps_ = !(cores.distance > gjk_floor);
  if (!overlaps_) {
    offer(cores.n_W, 0);
    if (best_.axis.overlap < -margin) return false;
    best_.p_W = midway(a, b, best_.axis.n_W, 0.5 * (cores.p_WA + cores.p_WB));
    overlaps_ = has_gap(cores.distance, best_.axis.overlap - radii);
  }
  if (overlaps_) try_seeds();
  seed_ = best_;
  best_ = {};
  try_flats();
  double reach = cores.distance + gjk_floor;
  if (overlaps_) {
    reach = std::max(reach, std::min(seed_.axis.overlap, best_.axis.overlap) - radii);
  }
  is_deep_ = false;
  try_patches(reach * (1 + 1e-6) + 1e-9);
  // Beyond a part of the least radius of curvature minima may lie close together: look closer, now
  // that the depth is nearly known and leaves fewer patches.
  const double depth = std::min(seed_.axis.overlap, best_.axis.overlap) - radii;
  is_deep_ = overlaps_ &&
             depth > deep_share * std::min(a.solid.patches.sharpest, b.solid.patches.sharpest);
  if (is_deep_) try_patches(depth * (1 + 1e-6) + 1e-9);
  // A first guess is right to its own tolerance only; it wins if the patches were missed.
  if (seed_.axis.overlap < best_.axis.overlap - missed) best_ = seed_;
  pair = best_;
  return best_.axis.overlap > -margin;
}

}  // namespace twinarm
