// A collision shape with all that the narrow phase prepares for it, once.
#pragma once

#include <memory>

#include "collision/geometry/boundary_features.h"
#include "collision/geometry/polytope.h"
#include "collision/shapes/shape.h"
#include "solver/spatial/pose.h"

namespace twinarm {

struct MeshSurface;
std::shared_ptr<const MeshSurface> make_mesh_surface(const Shape& shape);

struct Solid {
  explicit Solid(const Shape& s)
      : shape(s),
        core(make_polytope(s)),
        patches(make_patches(s, core)),
        surface(make_mesh_surface(s)) {
    if (!core.exists && !surface) return;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 e = Vector3::Unit(axis);
      const double low = twinarm::support(s, -e)[axis], high = twinarm::support(s, e)[axis];
      centre[axis] = (low + high) / 2;
      half[axis] = (high - low) / 2;
    }
  }
  // Farthest point along d, in the frame of the shape.
  Vector3 support(const Vector3& d) const {
    if (std::holds_alternative<ConvexHull>(shape)) return core.hull.vertices[core.farthest(d)];
    return twinarm::support(shape, d);
  }

  Shape shape;
  Polytope core;
  Patches patches;
  std::shared_ptr<const MeshSurface> surface;  // of a triangle mesh, else null
  // The bounding box in its own axes, of what has vertices [m].
  Vector3 centre = Vector3::Zero(), half = Vector3::Zero();
};

// A solid where it stands in this step. Cheap to copy; does not own.
struct Placed {
  const Solid& solid;
  const Pose& X_WG;

  // Farthest point along n_W, in W.
  Vector3 support_W(const Vector3& n_W) const {
    return X_WG * solid.support(X_WG.R.transpose() * n_W);
  }
};

// How far B must move along the unit vector n_W until a plane across n_W parts it from A:
//   overlap(n) = h_A(n) + h_B(-n)
// For convex bodies this is at least the signed depth for EVERY n, and equals it at the normal of
// least translation. So any n can be checked, and the better of two chosen, without knowing where
// they came from.
inline double overlap(const Placed& a, const Placed& b, const Vector3& n_W) {
  return (a.support_W(n_W) - b.support_W(-n_W)).dot(n_W);
}

// A unit direction from A to B and the overlap along it [m].
struct Axis {
  Vector3 n_W = Vector3::Zero();
  double overlap = 1e300;
};

}  // namespace twinarm
