// Each near triangle is a thin polytope for the narrow phase of convex bodies; what is special is
// which normals it may have. A body that lies over a triangle touches it along the triangle's own
// normal. Beyond a side the normal leans over it, which is real only where the mesh is convex
// there: the normal must lean out of the neighbour as well. That is asked only of the sides that
// the point of contact lies on: in a triangle with an obtuse corner a normal on one side leans over
// another side too. Along flat and hollow edges the neighbour has the contact, so a ball rolls over
// them and feels nothing. Contacts that two triangles share, on their common edge, are kept once.
//
// Along a triangle's own normal the depth is how far the body reaches behind its plane, and that is
// false round a corner: a box that rests on a tread and hangs over its edge reaches far behind the
// wall below. It does not lie over the wall as long as it is apart from the tread; but a hair deep
// there, the two have a sliver in common as seen along the wall's normal. Now what is inside a
// solid is no deeper than it is far from the surface. So contacts are taken in ascending order of
// depth; one along a triangle's normal counts only if nothing on its way down is much nearer to a
// triangle that the body hardly touches.
#include "collision/detection/mesh_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "collision/narrow_phase/gjk.h"

namespace twinarm {
namespace {

constexpr double lean = 1e-6;              // sine of an angle that counts as leaning
constexpr double same_point = 1e-9;        // [m]
constexpr double on_side = 1e-6;           // a point as near to a side lies on it [m]
constexpr double same_direction = 0.9999;  // cosine
// Of its depth: a point that is nearer than this to another triangle is not that deep. Less than 1,
// for triangles that bend mildly agree on a depth but for the cosine between them.
constexpr double part_of_depth = 0.5;
// Two points as near as this may be one for the clipping of features (clip.cpp) [m].
constexpr double clipped_as_one = 1e-9;
// distance() asks for contacts from this far apart: what is flush within rounding counts.
constexpr double flush = 1e-6;  // [m]

Aabb box_in(const PosedShape& mesh, const PosedShape& body, double margin) {
  const Pose X_MB = mesh.X_WG.inverse() * body.X_WG;
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 e = Vector3::Unit(axis), d = X_MB.R.transpose() * e;
    box.high[axis] = (X_MB * body.solid.support(d))[axis] + margin;
    box.low[axis] = (X_MB * body.solid.support(-d))[axis] - margin;
  }
  return box;
}

// Whether a normal (in the frame of the mesh) may be that of a contact with this triangle, at its
// point p.
bool is_own(const Vector3& n, const Vector3& front, const Vector3& p, const MeshSurface& surface,
            int t) {
  if (n.dot(front) < -lean) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const MeshSurface::Side& side = surface.sides[t][i];
    const Vector3& corner = surface.triangles[t].core.hull.vertices[i];
    if (n.dot(side.outward) > lean && n.dot(side.of_neighbour) < -lean &&
        side.outward.dot(p - corner) > -on_side)
      return false;
  }
  return true;
}

// Of a point (in the frame of the mesh) from triangle t: where it is over the triangle from its
// plane, else from the nearest side.
double distance_from(const Vector3& p, const MeshSurface& surface, int t) {
  const std::vector<Vector3>& corners = surface.triangles[t].core.hull.vertices;
  bool is_over = true;
  double nearest = 1e300;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 &a = corners[i], along = corners[(i + 1) % 3] - a;
    is_over = is_over && surface.sides[t][i].outward.dot(p - a) <= 0;
    const double part = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - a - part * along).squaredNorm());
  }
  return is_over ? std::abs(surface.normals[t].dot(p - corners[0])) : std::sqrt(nearest);
}

}  // namespace

void MeshContact::take(const std::vector<ManifoldPoint>& points, Along along, const Vector3& n_W,
                       int t, double margin) {
  const std::size_t first = all_.size();
  double deepest = -1e300;
  for (ManifoldPoint point : points) {
    if (!(point.depth > -margin)) continue;
    point.n_W = n_W;
    point.feature = feature_name(t, point.feature, 0, 11);
    all_.push_back(point);
    deepest = std::max(deepest, point.depth);
  }
  if (all_.size() > first) touches_.push_back({t, along, deepest, first, all_.size()});
}

// By what is hardly touched and yet near the line from the triangle down to the body's point.
bool MeshContact::is_false(const PosedShape& mesh, const ManifoldPoint& point) const {
  const MeshSurface& surface = *mesh.solid.surface;
  const Pose X_MW = mesh.X_WG.inverse();
  const Vector3 top = X_MW * point.p_WA, down = X_MW * point.p_WB - top;
  for (const Touch& touch : true_) {
    const double hardly = std::max(touch.deepest, clipped_as_one);
    if (point.depth < 4 * hardly) return false;  // they ascend
    const Vector3& corner = surface.triangles[touch.triangle].core.hull.vertices[0];
    for (double part = 1; part * point.depth > 2 * hardly; part *= 0.5) {
      const Vector3 p = top + part * down;
      const double near = part_of_depth * part * point.depth;
      if (std::abs(surface.normals[touch.triangle].dot(p - corner)) < near &&
          distance_from(p, surface, touch.triangle) < near)
        return true;
    }
  }
  return false;
}

// From all_ to kept_, in the order of the triangles: of a point that two share, the name stays.
void MeshContact::remove_ghost_contacts(const PosedShape& mesh) {
  std::sort(touches_.begin(), touches_.end(), [](const Touch& x, const Touch& y) {
    return std::tie(x.deepest, x.triangle) < std::tie(y.deepest, y.triangle);
  });
  true_.clear();
  for (Touch& touch : touches_) {
    const auto begin = all_.begin() + static_cast<std::ptrdiff_t>(touch.first),
               end = all_.begin() + static_cast<std::ptrdiff_t>(touch.last);
    if (touch.along == Along::front) {
      const auto last = std::remove_if(
          begin, end, [&](const ManifoldPoint& point) { return is_false(mesh, point); });
      touch.last = touch.first + static_cast<std::size_t>(last - begin);
    }
    if (touch.last > touch.first) true_.push_back(touch);
  }
  std::sort(touches_.begin(), touches_.end(),
            [](const Touch& x, const Touch& y) { return x.first < y.first; });
  kept_.clear();
  for (const Touch& touch : touches_)
    for (std::size_t i = touch.first; i < touch.last; ++i) kept_.push_back(all_[i]);
}

void MeshContact::touch_triangle(NarrowPhase& narrow_phase, const PosedShape& mesh, int t,
                                 const PosedShape& body, double margin) {
  const MeshSurface& surface = *mesh.solid.surface;
  const PosedShape triangle{surface.triangles[t], mesh.X_WG};
  Vector3 n_W = mesh.X_WG.R * surface.normals[t];
  const Vector3 corner_W = mesh.X_WG * triangle.solid.core.hull.vertices[0];
  const bool is_behind = n_W.dot(body.X_WG.p - corner_W) < 0;
  if (is_behind && !surface.is_open) return;
  if (is_behind) n_W = -n_W;
  const PenetrationDirection front{n_W, overlap(triangle, body, n_W)};
  if (!(front.overlap > -margin)) return;
  const std::vector<ManifoldPoint>& over = manifold_.features(triangle, body, front);
  const bool lies_over = std::any_of(over.begin(), over.end(), [&](const ManifoldPoint& point) {
    return point.depth > front.overlap - same_point;
  });
  if (lies_over) return take(over, Along::front, n_W, t, margin);
  NearestPair pair;
  if (!narrow_phase.nearest(triangle, body, margin, pair)) return;
  // From midway to the triangle's own point.
  const Vector3 p_W = pair.p_W + 0.5 * pair.axis.overlap * pair.axis.n_W;
  const Matrix3 R_MW = mesh.X_WG.R.transpose();
  if (!is_own(R_MW * pair.axis.n_W, R_MW * n_W, mesh.X_WG.inverse() * p_W, surface, t)) {
    return take(over, Along::front, n_W, t, margin);
  }
  take(manifold_.between(triangle, body, pair.axis, pair.p_W, margin), Along::leaning,
       pair.axis.n_W, t, margin);
}

// Direction by direction, deepest first: each point once, four at most.
void MeshContact::reduce_contacts() {
  kept_.clear();
  while (!all_.empty()) {
    double deepest = -1e300;
    for (const ManifoldPoint& point : all_) deepest = std::max(deepest, point.depth);
    const auto first = std::find_if(all_.begin(), all_.end(), [&](const ManifoldPoint& point) {
      return point.depth > deepest - same_point;
    });
    const Vector3 n = first->n_W;
    group_.clear();
    for (const ManifoldPoint& point : all_) {
      if (point.n_W.dot(n) < same_direction) continue;
      const bool is_known = std::any_of(group_.begin(), group_.end(), [&](const auto& other) {
        return (other.p_WA - point.p_WA).norm() < same_point;
      });
      if (!is_known) group_.push_back(point);
    }
    std::erase_if(all_, [&](const auto& point) { return !(point.n_W.dot(n) < same_direction); });
    reduce_to_four(n, group_);
    kept_.insert(kept_.end(), group_.begin(), group_.end());
  }
}

const std::vector<ManifoldPoint>& MeshContact::contacts(NarrowPhase& narrow_phase,
                                                        const PosedShape& mesh,
                                                        const PosedShape& body, double margin) {
  near_.clear();
  all_.clear();
  touches_.clear();
  mesh.solid.surface->find(box_in(mesh, body, margin), near_);
  for (int t : near_) touch_triangle(narrow_phase, mesh, t, body, margin);
  remove_ghost_contacts(mesh);
  std::swap(all_, kept_);
  reduce_contacts();
  return kept_;
}

double MeshContact::distance(NarrowPhase& narrow_phase, const PosedShape& mesh,
                             const PosedShape& body) {
  double deepest = 0;
  for (const ManifoldPoint& point : contacts(narrow_phase, mesh, body, flush)) {
    deepest = std::max(deepest, point.depth);
  }
  if (deepest > 0) return -deepest;
  double least = 1e300;
  for (const PreparedShape& triangle : mesh.solid.surface->triangles) {
    least = std::min(least, narrow_phase.distance({triangle, mesh.X_WG}, body));
  }
  return std::max(least, 0.0);
}

}  // namespace twinarm
