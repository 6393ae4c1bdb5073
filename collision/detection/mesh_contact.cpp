// Each near triangle is a flat polytope in the narrow phase of convex bodies. The problem is
// internal edges: which normals are valid. A body over a triangle has the triangle's normal. Beyond
// a side the normal is tilted over that side, which is valid only where the mesh is convex there:
// the normal must be tilted out of the neighbour as well. This is tested only for the sides on
// which the contact point lies. At flat and concave edges the contact belongs to the neighbour, so
// a sphere rolls across them smoothly. Contacts on a common edge are kept once.
//
// With a triangle's normal, the depth is the reach of the body behind the triangle's plane, which
// is wrong around a corner: a box that rests on a tread and extends over its edge reaches far
// behind the riser below. A point inside a solid is no deeper than its distance from the surface.
// So contacts are accepted in ascending order of depth, and a contact with a triangle's normal is a
// ghost contact if a point on its path through the solid is much closer to a triangle that the body
// barely touches.
#include "collision/detection/mesh_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "collision/narrow_phase/gjk.h"

namespace twinarm {
namespace {

constexpr double kMinLean = 1e-6;          // sine of the smallest tilt that counts
constexpr double kSamePoint = 1e-9;        // [m]
constexpr double kOnSide = 1e-6;           // distance of points that lie on a side [m]
constexpr double kSameDirection = 0.9999;  // cosine
// A point closer to another triangle than this share of its depth is a ghost. Below 1: on a mildly
// curved surface the depths of neighbouring triangles differ by the cosine between them.
constexpr double kDepthShare = 0.5;
// Tolerance of the clipping (clip.cpp) [m].
constexpr double kClipTolerance = 1e-9;
// Margin of distance(): flush surfaces are contacts in spite of rounding.
constexpr double kFlush = 1e-6;  // [m]

// Whether n (mesh frame) is a valid normal of a contact with triangle t at its point p (internal
// edges).
bool is_valid_normal(const Vector3& n, const Vector3& face, const Vector3& p,
                     const MeshSurface& surface, int t) {
  if (n.dot(face) < -kMinLean) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const MeshSurface::Side& side = surface.sides[t][i];
    const Vector3& vertex = surface.triangles[t].core.hull.vertices[i];
    if (n.dot(side.outward) > kMinLean && n.dot(side.of_neighbour) < -kMinLean &&
        side.outward.dot(p - vertex) > -kOnSide)
      return false;
  }
  return true;
}

// Distance of a point (mesh frame) from triangle t.
double distance_from(const Vector3& p, const MeshSurface& surface, int t) {
  const std::vector<Vector3>& vertices = surface.triangles[t].core.hull.vertices;
  bool is_over = true;
  double min_square = 1e300;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 &a = vertices[i], along = vertices[(i + 1) % 3] - a;
    is_over = is_over && surface.sides[t][i].outward.dot(p - a) <= 0;
    const double part = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    min_square = std::min(min_square, (p - a - part * along).squaredNorm());
  }
  return is_over ? std::abs(surface.normals[t].dot(p - vertices[0])) : std::sqrt(min_square);
}

}  // namespace

void MeshContact::add_points(const std::vector<ManifoldPoint>& points, NormalKind along,
                             const Vector3& n_W, int t, double margin) {
  const std::size_t first = all_.size();
  double deepest = -1e300;
  for (ManifoldPoint point : points) {
    if (!(point.depth > -margin)) continue;
    point.n_W = n_W;
    point.feature = feature_name(t, point.feature, 0, 11);
    all_.push_back(point);
    deepest = std::max(deepest, point.depth);
  }
  if (all_.size() > first) triangle_contacts_.push_back({t, along, deepest, first, all_.size()});
}

// Whether an accepted, much shallower contact's triangle is close to the segment from the triangle
// to the body's point.
bool MeshContact::is_ghost(const PosedShape& mesh, const ManifoldPoint& point) const {
  const MeshSurface& surface = *mesh.solid.surface;
  const Pose X_MW = mesh.X_WG.inverse();
  const Vector3 top = X_MW * point.p_WA, down = X_MW * point.p_WB - top;
  for (const TriangleContact& contact : accepted_) {
    const double shallow = std::max(contact.deepest, kClipTolerance);
    if (point.depth < 4 * shallow) return false;  // accepted_ is ascending
    const Vector3& vertex = surface.triangles[contact.triangle].core.hull.vertices[0];
    for (double part = 1; part * point.depth > 2 * shallow; part *= 0.5) {
      const Vector3 p = top + part * down;
      const double near = kDepthShare * part * point.depth;
      if (std::abs(surface.normals[contact.triangle].dot(p - vertex)) < near &&
          distance_from(p, surface, contact.triangle) < near)
        return true;
    }
  }
  return false;
}

// Copies all_ without ghosts to kept_, in the order of triangles (so that shared points keep their
// feature).
void MeshContact::remove_ghost_contacts(const PosedShape& mesh) {
  std::ranges::sort(triangle_contacts_, {}, [](const TriangleContact& contact) {
    return std::pair(contact.deepest, contact.triangle);
  });
  accepted_.clear();
  for (TriangleContact& contact : triangle_contacts_) {
    const auto begin = all_.begin() + static_cast<std::ptrdiff_t>(contact.first),
               end = all_.begin() + static_cast<std::ptrdiff_t>(contact.last);
    if (contact.along == NormalKind::face) {
      const auto last = std::remove_if(
          begin, end, [&](const ManifoldPoint& point) { return is_ghost(mesh, point); });
      contact.last = contact.first + static_cast<std::size_t>(last - begin);
    }
    if (contact.last > contact.first) accepted_.push_back(contact);
  }
  std::ranges::sort(triangle_contacts_, {}, &TriangleContact::first);
  kept_.clear();
  for (const TriangleContact& contact : triangle_contacts_)
    for (std::size_t i = contact.first; i < contact.last; ++i) kept_.push_back(all_[i]);
}

void MeshContact::collide_triangle(NarrowPhase& narrow_phase, const PosedShape& mesh, int t,
                                   const PosedShape& body, double margin) {
  const MeshSurface& surface = *mesh.solid.surface;
  const PosedShape triangle{surface.triangles[t], mesh.X_WG};
  Vector3 n_W = mesh.X_WG.R * surface.normals[t];
  const Vector3 corner_W = mesh.X_WG * triangle.solid.core.hull.vertices[0];
  const bool is_behind = n_W.dot(body.X_WG.p - corner_W) < 0;
  if (is_behind && !surface.is_open) return;
  if (is_behind) n_W = -n_W;
  const PenetrationDirection face{n_W, overlap(triangle, body, n_W)};
  if (!(face.overlap > -margin)) return;
  const std::vector<ManifoldPoint>& over = manifold_.features(triangle, body, face);
  const bool lies_over = std::any_of(over.begin(), over.end(), [&](const ManifoldPoint& point) {
    return point.depth > face.overlap - kSamePoint;
  });
  if (lies_over) return add_points(over, NormalKind::face, n_W, t, margin);
  NearestPair pair;
  if (!narrow_phase.nearest(triangle, body, margin, pair)) return;
  // Point of the triangle.
  const Vector3 p_W = pair.p_W + 0.5 * pair.axis.overlap * pair.axis.n_W;
  const Matrix3 R_MW = mesh.X_WG.R.transpose();
  if (!is_valid_normal(R_MW * pair.axis.n_W, R_MW * n_W, mesh.X_WG.inverse() * p_W, surface, t))
    return add_points(over, NormalKind::face, n_W, t, margin);
  add_points(manifold_.between(triangle, body, pair.axis, pair.p_W, margin), NormalKind::edge,
             pair.axis.n_W, t, margin);
}

// Manifold reduction: normal by normal, deepest first; duplicates removed, at most four points
// each.
void MeshContact::reduce_contacts() {
  kept_.clear();
  while (!all_.empty()) {
    double deepest = -1e300;
    for (const ManifoldPoint& point : all_) deepest = std::max(deepest, point.depth);
    const auto first = std::find_if(all_.begin(), all_.end(), [&](const ManifoldPoint& point) {
      return point.depth > deepest - kSamePoint;
    });
    const Vector3 n = first->n_W;
    group_.clear();
    for (const ManifoldPoint& point : all_) {
      if (point.n_W.dot(n) < kSameDirection) continue;
      const bool is_known = std::any_of(group_.begin(), group_.end(), [&](const auto& other) {
        return (other.p_WA - point.p_WA).norm() < kSamePoint;
      });
      if (!is_known) group_.push_back(point);
    }
    std::erase_if(all_, [&](const auto& point) { return !(point.n_W.dot(n) < kSameDirection); });
    reduce_to_four(n, group_);
    kept_.insert(kept_.end(), group_.begin(), group_.end());
  }
}

const std::vector<ManifoldPoint>& MeshContact::contacts(NarrowPhase& narrow_phase,
                                                        const PosedShape& mesh,
                                                        const PosedShape& body, double margin) {
  near_.clear();
  all_.clear();
  triangle_contacts_.clear();
  const Pose X_MB = mesh.X_WG.inverse() * body.X_WG;
  mesh.solid.surface->find(bounding_box({body.solid, X_MB}, margin), near_);
  for (int t : near_) collide_triangle(narrow_phase, mesh, t, body, margin);
  remove_ghost_contacts(mesh);
  std::swap(all_, kept_);
  reduce_contacts();
  return kept_;
}

double MeshContact::distance(NarrowPhase& narrow_phase, const PosedShape& mesh,
                             const PosedShape& body) {
  double deepest = 0;
  for (const ManifoldPoint& point : contacts(narrow_phase, mesh, body, kFlush))
    deepest = std::max(deepest, point.depth);
  if (deepest > 0) return -deepest;
  double least = 1e300;
  for (const PreparedShape& triangle : mesh.solid.surface->triangles)
    least = std::min(least, narrow_phase.distance({triangle, mesh.X_WG}, body));
  return std::max(least, 0.0);
}

}  // namespace twinarm
