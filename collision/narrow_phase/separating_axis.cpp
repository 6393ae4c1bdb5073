// Minimum overlap of two convex polytopes by enumeration (separating-axis theorem).
//
// The bodies overlap by d along n iff the plane with normal n at distance d supports the Minkowski
// difference A - B; with penetration the origin is nearest to one of its faces. These are the faces
// of A, the faces of -B, and one parallelogram for each edge pair (e_a, e_b) whose arcs on the
// Gauss sphere cross. With the normals p, q adjacent to e_a and -r, -s adjacent to e_b:
//   the arcs p-q and (-r)-(-s) cross  <=>  opposite signs of (-r).(q x p), (-s).(q x p), opposite
//   signs of p.(s x r), q.(s x r), and the same hemisphere,
// where q x p is along e_a and s x r along e_b.
// S. Gottschalk, "Separating axis theorem", UNC TR96-024, 1996; D. Gregorius, "The separating axis
// test between convex polyhedra", GDC 2013, for the arcs.
// Cost: F_a V_b + F_b V_a + E_a E_b for the edges that are near the other body; box-box 0.4 us.

#include "collision/narrow_phase/separating_axis.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace twinarm {
namespace {

constexpr double kParallelEdgesSine = 1e-7;  // below it two edges count as parallel

double highest(const std::vector<Vector3>& points, const Vector3& n) {
  return support_point(points, n).dot(n);
}

}  // namespace

void SeparatingAxis::place(const PosedShape& body, Posed& posed) {
  const ConvexHull& hull = body.solid.core.hull;
  posed.vertices.clear();
  posed.normals.clear();
  for (const Vector3& v : hull.vertices) posed.vertices.push_back(body.X_WG * v);
  for (const Vector3& n : hull.normals) posed.normals.push_back(body.X_WG.R * n);
  posed.near_edges.reserve(body.solid.core.edges.size());
}

// The edges of the optimum are within `reach` of the other body's bounding box.
void SeparatingAxis::find_near_edges(const Polytope& core, const Posed& other, double reach,
                                     Posed& posed) {
  Aabb box = bounding_box(other.vertices);
  box.min().array() -= reach;
  box.max().array() += reach;
  posed.near_edges.clear();
  for (std::size_t i = 0; i < core.edges.size(); ++i) {
    const Vector3& v0 = posed.vertices[core.edges[i].v0];
    const Vector3& v1 = posed.vertices[core.edges[i].v1];
    if (box.intersects(Aabb(v0.cwiseMin(v1), v0.cwiseMax(v1))))
      posed.near_edges.push_back(static_cast<int>(i));
  }
}

double SeparatingAxis::overlap_along(const Vector3& n_W) const {
  return highest(a_.vertices, n_W) + highest(b_.vertices, -n_W);
}

void SeparatingAxis::try_faces(const PosedShape& body, const Posed& own, const Posed& other,
                               double sign, PenetrationDirection& best) const {
  const ConvexHull& hull = body.solid.core.hull;
  for (std::size_t f = 0; f < own.normals.size(); ++f) {
    const Vector3& n = own.normals[f];
    const double value = n.dot(body.X_WG.p) + hull.offsets[f] + highest(other.vertices, -n);
    if (value < best.overlap) best = {sign * n, value};
  }
}

bool SeparatingAxis::is_difference_face(const Polytope::Edge& ea, const Vector3& da,
                                        const Polytope::Edge& eb, const Vector3& db, const Posed& a,
                                        const Posed& b) {
  if (ea.f0 < 0 || eb.f0 < 0) return true;  // a segment has all normals
  // f0 traverses the edge forward: n(f0) x n(f1)
  // is along it, for either body.
  const double r = -b.normals[eb.f0].dot(da), s = -b.normals[eb.f1].dot(da);
  const double p = a.normals[ea.f0].dot(db), q = a.normals[ea.f1].dot(db);
  return r * s < 0 && p * q < 0 && r * q > 0;
}

void SeparatingAxis::try_edges(const Polytope& a, const Polytope& b,
                               PenetrationDirection& best) const {
  for (int i : a_.near_edges) {
    const Polytope::Edge& ea = a.edges[i];
    const Vector3& p_a = a_.vertices[ea.v0];
    const Vector3 da = a_.vertices[ea.v1] - p_a;
    for (int j : b_.near_edges) {
      const Polytope::Edge& eb = b.edges[j];
      const Vector3& p_b = b_.vertices[eb.v0];
      const Vector3 db = b_.vertices[eb.v1] - p_b;
      if (!is_difference_face(ea, da, eb, db, a_, b_)) continue;
      Vector3 n = da.cross(db);
      const double length = n.norm();
      if (length < kParallelEdgesSine * da.norm() * db.norm()) continue;
      n /= length;
      for (const double sign : {1.0, -1.0}) {
        // Lower bound: overlap of these two edges along n.
        if (sign * n.dot(p_a - p_b) >= best.overlap) continue;
        const double value = overlap_along(sign * n);
        if (value < best.overlap) best = {sign * n, value};
      }
    }
  }
}

void SeparatingAxis::improve(const PosedShape& a, const PosedShape& b, double reach,
                             PenetrationDirection& best) {
  place(a, a_);
  place(b, b_);
  try_faces(a, a_, b_, 1, best);
  try_faces(b, b_, a_, -1, best);
  const double near = std::max(reach, std::min(best.overlap, 1e3)) + 1e-9;
  find_near_edges(a.solid.core, b_, near, a_);
  find_near_edges(b.solid.core, a_, near, b_);
  try_edges(a.solid.core, b.solid.core, best);
}

// Polytopes: vertices of one body in the frame of the other, and one pass over them for each slab
// that can improve the result. Box-box: at most 48 products, 0.1 us. Against a curved body:
// overlap(n), of a face only where it can be better than the best before.
namespace {

// Points with minimum and maximum p . n.
std::pair<const Vector3*, const Vector3*> extremes(const std::vector<Vector3>& points,
                                                   const Vector3& n) {
  double low = 1e300, high = -1e300;
  const Vector3 *low_at = points.data(), *high_at = low_at;
  for (const Vector3& p : points) {
    const double h = n.dot(p);
    if (h < low) low = h, low_at = &p;
    if (h > high) high = h, high_at = &p;
  }
  return {low_at, high_at};
}

}  // namespace

// `own` is a with sign 1 or b with sign -1.
bool FaceAxis::try_flats(const PosedShape& a, const PosedShape& b, const PosedShape& own,
                         double sign, double margin, PenetrationDirection& axis) {
  const std::vector<Vector3>& face_normals = own.solid.boundary.face_normals;
  const PosedShape& other = sign > 0 ? b : a;
  const std::size_t first = face_depth_lower_bounds(own, other, bounds_);
  for (std::size_t k = 0; k < face_normals.size(); ++k) {
    const std::size_t f = (first + k) % face_normals.size();
    if (bounds_[f] > axis.overlap) continue;
    const Vector3 out = own.X_WG.R * face_normals[f];
    if (face_depth_lower_bound(own, f, out, other) > axis.overlap) continue;
    try_direction(a, b, sign * out, 0, axis);
    if (!(axis.overlap > -margin)) return false;
  }
  return true;
}

bool FaceAxis::try_slabs(const Polytope& own, const Polytope& other, const Pose& X_own_other,
                         double sign, double margin, const Matrix3& R_W_own, double radii,
                         PenetrationDirection& axis) {
  const std::vector<Vector3>& vertices = other.hull.vertices;
  vertices_.resize(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) vertices_[i] = X_own_other * vertices[i];
  const Vector3* deepest = vertices_.data();  // along the best direction so far
  for (const Polytope::Slab& slab : own.slabs) {
    // One vertex gives a bound; exact in floating point, since rounding is monotone.
    const double one = slab.normal.dot(*deepest);
    if (slab.high - one + radii >= axis.overlap &&
        (!slab.is_double || one - slab.low + radii >= axis.overlap))
      continue;
    const auto [low_at, high_at] = extremes(vertices_, slab.normal);
    const double low = slab.normal.dot(*low_at), high = slab.normal.dot(*high_at);
    const double above = slab.high - low + radii, below = high - slab.low + radii;
    if (above < axis.overlap) {
      axis = {sign * (R_W_own * slab.normal), above};
      deepest = low_at;
    }
    if (slab.is_double && below < axis.overlap) {
      axis = {-sign * (R_W_own * slab.normal), below};
      deepest = high_at;
    }
    if (axis.overlap <= -margin) return false;
  }
  return true;
}

bool FaceAxis::best_of_polytopes(const PosedShape& a, const PosedShape& b, double margin,
                                 PenetrationDirection& axis) {
  const Polytope &core_a = a.solid.core, &core_b = b.solid.core;
  const double radii = core_a.radius + core_b.radius;
  const Pose X_AB = a.X_WG.inverse() * b.X_WG;
  return try_slabs(core_a, core_b, X_AB, 1, margin, a.X_WG.R, radii, axis) &&
         try_slabs(core_b, core_a, X_AB.inverse(), -1, margin, b.X_WG.R, radii, axis);
}

}  // namespace twinarm
