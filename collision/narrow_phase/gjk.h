// Prepared and posed shapes, overlap along a direction, and the GJK distance of two convex cores.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "collision/shapes/shape.h"
#include "solver/spatial/pose.h"

namespace twinarm {

struct MeshSurface;
std::shared_ptr<const MeshSurface> make_mesh_surface(const Shape& shape);

struct PreparedShape {
  explicit PreparedShape(const Shape& s)
      : shape(s),
        core(make_polytope(s)),
        boundary(make_boundary(s, core)),
        surface(make_mesh_surface(s)) {
    if (!core.exists && !surface) return;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 e = Vector3::Unit(axis);
      const double low = twinarm::support(s, -e)[axis], high = twinarm::support(s, e)[axis];
      centre[axis] = (low + high) / 2;
      half[axis] = (high - low) / 2;
    }
  }
  // Support point in direction d, shape frame.
  Vector3 support(const Vector3& d) const {
    if (std::holds_alternative<ConvexHull>(shape)) return core.hull.vertices[core.support_index(d)];
    return twinarm::support(shape, d);
  }

  Shape shape;
  Polytope core;
  BoundaryFeatures boundary;
  std::shared_ptr<const MeshSurface> surface;  // of a triangle mesh, else null
  // Bounding box in the shape frame, of shapes with vertices [m].
  Vector3 centre = Vector3::Zero(), half = Vector3::Zero();
};

// A shape at a pose. Holds references.
struct PosedShape {
  const PreparedShape& solid;
  const Pose& X_WG;

  // Support point in direction n_W, in W.
  Vector3 support_W(const Vector3& n_W) const {
    return X_WG * solid.support(X_WG.R.transpose() * n_W);
  }
};

// Translation of B along the unit vector n_W until a plane with normal n_W separates it from A:
//   overlap(n) = h_A(n) + h_B(-n)
// For convex bodies an upper bound of the signed penetration depth for every n; equal to it at the
// normal of the minimum translation. So any candidate n can be verified, whatever algorithm found
// it.
inline double overlap(const PosedShape& a, const PosedShape& b, const Vector3& n_W) {
  return (a.support_W(n_W) - b.support_W(-n_W)).dot(n_W);
}

// World box that contains a bounded body, grown by the margin.
inline Aabb bounding_box(const PosedShape& body, double margin) {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 e = Vector3::Unit(axis);
    box.max()[axis] = body.support_W(e)[axis] + margin;
    box.min()[axis] = body.support_W(-e)[axis] - margin;
  }
  return box;
}

// A unit direction from A to B and the overlap along it [m].
struct PenetrationDirection {
  Vector3 n_W = Vector3::Zero();
  double overlap = 1e300;
};

constexpr double kMinGjkDistance = 1e-9;  // below it the nearest points define no direction [m]

struct CoreDistance {
  double distance = 0;             // between the cores; 0 where they overlap [m]
  Vector3 n_W = Vector3::Zero();   // unit, from A to B; zero where they overlap
  Vector3 p_WA = Vector3::Zero();  // nearest points
  Vector3 p_WB = Vector3::Zero();
};

// GJK distance of the cores: shapes without the radius of spheres and capsules (point, segment).
// Ends early where the cores are more than `far` apart; the distance is then an upper bound above
// `far`. A function of the poses only; does not allocate. Polytopes 0.2-1 us, curved shapes 1-4 us.
CoreDistance core_distance(const PosedShape& a, const PosedShape& b, double far = 1e300);

// Whether a distance and the bound from its direction differ by more than rounding; for the true
// nearest points distance = -overlap(n).
bool has_duality_gap(double distance, double core_overlap);

// Replaces `best` by the direction n_W (of any length) if its overlap is smaller by more than
// `min_gain`.
void try_direction(const PosedShape& a, const PosedShape& b, Vector3 n_W, double min_gain,
                   PenetrationDirection& best);

// Lower bounds of the overlaps along the face normals of a hull (minus infinity for other shapes),
// cheaper than overlap(): of all faces from one point of the other body (returns the index of the
// smallest), and of face `f` with normal n_W from the other body's support.
std::size_t face_depth_lower_bounds(const PosedShape& body, const PosedShape& other,
                                    std::vector<double>& bounds);
double face_depth_lower_bound(const PosedShape& body, std::size_t f, const Vector3& n_W,
                              const PosedShape& other);

// p_W moved along n_W to the middle between the two supporting planes.
Vector3 midway(const PosedShape& a, const PosedShape& b, const Vector3& n_W, const Vector3& p_W);

Vector3 mean_of_supports(const PosedShape& a, const PosedShape& b, const Vector3& n_W);

}  // namespace twinarm
