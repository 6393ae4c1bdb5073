// Least overlap of a cylinder and another convex body, by GJK, a certificate, and a search.
//
// Apart: the nearest points of GJK are exact. Overlapping: GJK on eroded cylinders gives a first
// direction, and with the erosion m also a lower bound: a cylinder contains its eroded self rolled
// about by a ball of radius m, so depth >= m_A + m_B - distance(eroded). If the direction or a
// normal of the touching faces reaches that bound, it is optimal and nothing is searched: flat on
// flat, side on face, and all that does not touch with a rim.
//
// Otherwise the optimum, a smooth point of the Minkowski difference, is on one of few kinds of
// patch:
//   cap or polyhedron face            n is that normal;
//   cylinder side with anything       n across the axis of the cylinder: one angle is free;
//   polyhedron edge with a rim        n across the edge: one angle is free;
//   rim with rim                      smooth: any descent finds it.
// So the search runs along the circles across these lines ("ridges", which a plain descent cannot
// follow), then descends. Local: good to 1e-8 m next to the first direction; deep overlaps, started
// from a list of directions, may end in another local optimum, never in a wrong depth for their n.
// Cost: 2-5 us apart or certified, 20-60 us searched, a few hundred if deeper than the first
// erosion.
#include "collision/cylinder_axis.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "collision/direction.h"

namespace twinarm {
namespace {

constexpr double prefer_face = 1e-10;   // a face normal wins over a direction this much better [m]
constexpr double certain = 1e-9;        // distance from a bound at which the search ends [m]
constexpr double top_layer = 1e-3;      // edges this near to the top are searched across [m]
constexpr int deep_starts = 6;          // valleys that are searched in a deep overlap
constexpr double clearly_apart = 1e-6;  // from here on GJK's nearest points are exact enough [m]

// Minimum over the circle across `ridge`, within 0.4 rad of the best direction: 9 samples, then
// golden section about the best of them.
void search_circle(const Placed& a, const Placed& b, const Vector3& ridge, Axis& best) {
  Vector3 u = best.n_W - ridge * ridge.dot(best.n_W);
  if (u.norm() < 0.5) return;
  u.normalize();
  const Vector3 v = ridge.cross(u);
  const auto at = [&](double angle) { return Vector3(std::cos(angle) * u + std::sin(angle) * v); };
  const auto value = [&](double angle) { return overlap(a, b, at(angle)); };
  double centre = 0, least = value(0);
  for (int k = -4; k <= 4; ++k) {
    const double found = value(0.1 * k);
    if (found < least) {
      least = found;
      centre = 0.1 * k;
    }
  }
  constexpr double golden = 0.61803398874989484820;
  double low = centre - 0.1, high = centre + 0.1;
  double x1 = high - golden * (high - low), x2 = low + golden * (high - low);
  double f1 = value(x1), f2 = value(x2);
  while (high - low > 1e-9) {
    if (f1 < f2) {
      high = x2, x2 = x1, f2 = f1;
      f1 = value(x1 = high - golden * (high - low));
    } else {
      low = x1, x1 = x2, f1 = f2;
      f2 = value(x2 = low + golden * (high - low));
    }
  }
  consider(a, b, at(centre), 0, best);
  consider(a, b, at((low + high) / 2), 0, best);
}

// Eight neighbours, halving the step.
void descend(const Placed& a, const Placed& b, Axis& best) {
  for (double step = 0.05; step > 1e-7;) {
    const Axis before = best;
    const Vector3 u = before.n_W.unitOrthogonal(), w = before.n_W.cross(u);
    for (int k = 0; k < 8; ++k) {
      const double angle = 0.25 * M_PI * k;
      consider(a, b, before.n_W + step * (std::cos(angle) * u + std::sin(angle) * w), 0, best);
    }
    if (!(best.overlap < before.overlap - 1e-12)) step /= 2;
  }
}

// Lines of `body` near its top along n_W, across which a normal may have to be.
void add_ridges(const Placed& body, const Vector3& n_W, std::vector<Vector3>& ridges_W) {
  const Polytope& core = body.solid.core;
  if (!core.exists || !core.edges.empty()) {
    if (!core.exists || core.edges[0].f0 < 0) ridges_W.push_back(body.X_WG.R.col(2));
  }
  if (!core.exists || core.hull.faces.empty()) return;
  const Vector3 n = body.X_WG.R.transpose() * n_W;
  const double near_top = support(body.solid.shape, n).dot(n) - top_layer;
  for (const Polytope::Edge& edge : core.edges) {
    const Vector3 &p = core.hull.vertices[edge.v0], &q = core.hull.vertices[edge.v1];
    if (std::max(p.dot(n), q.dot(n)) >= near_top)
      ridges_W.push_back(body.X_WG.R * (q - p).normalized());
  }
}

}  // namespace

// Flat on flat: the normals of the two faces that look at each other, exactly.
void CylinderAxis::consider_faces(const Placed& a, const Placed& b, Axis& best) {
  const Vector3 n = best.n_W;
  support_feature(a, n, feature_);
  if (feature_.is_polygon()) consider(a, b, feature_.normal_W, -prefer_face, best);
  support_feature(b, -n, feature_);
  if (feature_.is_polygon()) consider(a, b, -feature_.normal_W, prefer_face, best);
}

void CylinderAxis::refine(const Placed& a, const Placed& b, Axis& best) {
  for (int round = 0; round < 4; ++round) {
    const double before = best.overlap;
    ridges_W_.clear();
    add_ridges(a, best.n_W, ridges_W_);
    add_ridges(b, -best.n_W, ridges_W_);
    for (const Vector3& ridge : ridges_W_) search_circle(a, b, ridge, best);
    descend(a, b, best);
    consider_faces(a, b, best);
    if (best.overlap > before - certain) return;
  }
}

void CylinderAxis::add_start(const Placed& a, const Placed& b, const Vector3& n_W) {
  Axis axis;
  consider(a, b, n_W, 0, axis);
  if (!axis.n_W.isZero()) starts_.push_back(axis);
}

// Directions in whose neighbourhood a deep overlap may be least: MPR, faces, axes, edges across
// axes, and a spiral all round, evenly, that misses no valley wider than a fifth of a radian.
void CylinderAxis::add_deep_starts(const Placed& a, const Placed& b) {
  const auto add = [&](const Vector3& n_W) { add_start(a, b, n_W); };
  const Pose &X_WA = a.X_WG, &X_WB = b.X_WG;
  if (const auto n = penetration_direction(a.solid.fcl, X_WA, b.solid.fcl, X_WB)) add(*n);
  if (const auto n = penetration_direction(b.solid.fcl, X_WB, a.solid.fcl, X_WA)) add(-*n);
  for (const Vector3& n : a.solid.core.hull.normals) add(X_WA.R * n);
  for (const Vector3& n : b.solid.core.hull.normals) add(-(X_WB.R * n));
  const Vector3 z_A = X_WA.R.col(2), z_B = X_WB.R.col(2), between = X_WB.p - X_WA.p;
  for (const Vector3& n : {z_A, z_B, Vector3(z_A.cross(z_B))}) {
    add(n);
    add(-n);
  }
  add(between);
  add(between - z_A * z_A.dot(between));
  add(between - z_B * z_B.dot(between));
  const auto add_edges = [&](const Placed& body, const Vector3& axis_W) {
    const Polytope& core = body.solid.core;
    for (const Polytope::Edge& edge : core.edges) {
      const Vector3 along = core.hull.vertices[edge.v1] - core.hull.vertices[edge.v0];
      const Vector3 n = (body.X_WG.R * along).cross(axis_W);
      if (n.norm() < 1e-6 * along.norm()) continue;
      add(n);
      add(-n);
    }
  };
  add_edges(a, z_B);
  add_edges(b, z_A);
  constexpr int count = 256;
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, r = std::sqrt(1 - z * z), angle = 2.399963 * k;
    add({r * std::cos(angle), r * std::sin(angle), z});
  }
}

// Refines from the best start, then from the best that is not near it, and so on.
void CylinderAxis::refine_starts(const Placed& a, const Placed& b, int count, Axis& best) {
  for (int i = 0; i < count; ++i) {
    const auto start =
        std::min_element(starts_.begin(), starts_.end(),
                         [](const Axis& x, const Axis& y) { return x.overlap < y.overlap; });
    if (start == starts_.end()) return;
    Axis found = *start;
    const Vector3 used = start->n_W;
    refine(a, b, found);
    if (found.overlap < best.overlap - prefer_face) best = found;
    std::erase_if(starts_, [&](const Axis& x) { return x.n_W.dot(used) > 0.9; });
  }
}

// `cores`: in, of the whole bodies; out, of those that gave a direction.
void CylinderAxis::overlapping(const Placed& a, const Placed& b, CoreDistance& cores, Axis& best) {
  const double radii = a.solid.core.radius + b.solid.core.radius;
  double bound = radii - cores.distance;
  starts_.clear();
  int level = 1;
  for (; level < core_count; ++level) {  // the least erosion that lets the cores part
    const Core core = static_cast<Core>(level);
    cores = distance_of(a, b, core);
    if (!(cores.distance > gjk_floor)) continue;
    bound = radii + a.solid.fcl.erosion(core) + b.solid.fcl.erosion(core) - cores.distance;
    add_start(a, b, cores.p_WB - cores.p_WA);
    break;
  }
  if (level > 1) add_deep_starts(a, b);
  for (const Axis& start : starts_) {
    if (start.overlap < best.overlap) best = start;
  }
  const Vector3 n_best = best.n_W;
  consider_faces(a, b, best);
  if (best.overlap <= bound + certain) return;
  add_start(a, b, n_best);
  refine_starts(a, b, level > 1 ? deep_starts : 2, best);
}

bool CylinderAxis::nearest(const Placed& a, const Placed& b, double margin, NearestPair& pair) {
  Axis best;
  CoreDistance cores = distance_of(a, b, Core::whole);
  const double radii = a.solid.core.radius + b.solid.core.radius;
  if (cores.distance > gjk_floor) {
    consider(a, b, cores.p_WB - cores.p_WA, 0, best);
    if (best.overlap < -margin) return false;
    consider_faces(a, b, best);
  }
  if (!(cores.distance > clearly_apart) || has_gap(cores.distance, best.overlap - radii)) {
    overlapping(a, b, cores, best);
  }
  pair.axis = best;
  const Vector3 between = cores.p_WB - cores.p_WA;
  const bool has_points = cores.distance > gjk_floor && between.normalized().dot(best.n_W) > 0.9;
  pair.p_W = has_points ? midway(a, b, best.n_W, 0.5 * (cores.p_WA + cores.p_WB))
                        : mean_of_supports(a, b, best.n_W);
  return best.overlap > -margin;
}

}  // namespace twinarm
