// A collision shape with all that the narrow phase prepares for it, once.
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
struct PosedShape {
  const PreparedShape& solid;
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
inline double overlap(const PosedShape& a, const PosedShape& b, const Vector3& n_W) {
  return (a.support_W(n_W) - b.support_W(-n_W)).dot(n_W);
}

// A unit direction from A to B and the overlap along it [m].
struct PenetrationDirection {
  Vector3 n_W = Vector3::Zero();
  double overlap = 1e300;
};

// Nearest points of two convex cores that are apart: the distance algorithm of Gilbert, Johnson and
// Keerthi.
constexpr double gjk_floor = 1e-9;  // nearer than this, nearest points give no direction [m]

struct CoreDistance {
  double distance = 0;             // between the cores; 0 where they overlap [m]
  Vector3 n_W = Vector3::Zero();   // unit, from A to B; zero where they overlap
  Vector3 p_WA = Vector3::Zero();  // nearest points
  Vector3 p_WB = Vector3::Zero();
};

// The core is the shape without the radius of spheres and capsules (a point, a segment). The search
// ends early where the cores are certainly more than `far` apart; the distance is then at least
// that, and no more than an upper bound. A pure function of the poses; does not allocate.
// Polytopes 0.2-1 us, curved shapes 1-4 us.
CoreDistance core_distance(const PosedShape& a, const PosedShape& b, double far = 1e300);

// What the searches for a contact direction share: judging a candidate, and placing the point.

// Whether a distance that was found and the bound from its direction differ by more than rounding:
// for the true nearest points, distance = -overlap(n).
bool has_gap(double distance, double core_overlap);

// Takes the direction n_W (of any length) for `best` if its overlap is less by more than
// `handicap`.
void consider(const PosedShape& a, const PosedShape& b, Vector3 n_W, double handicap,
              PenetrationDirection& best);

// Lower bounds of the overlaps along the flats of a hull (of other bodies: minus infinity), where
// overlap() asks all corners: of all flats from one point of the other body, a dot product each;
// returns the place of the least. And of flat `f` with normal n_W, from the other body's support.
std::size_t face_depth_lower_bounds(const PosedShape& body, const PosedShape& other,
                                    std::vector<double>& bounds);
double bound_flat(const PosedShape& body, std::size_t f, const Vector3& n_W,
                  const PosedShape& other);

// p_W moved along n_W to the middle between the two supporting planes.
Vector3 midway(const PosedShape& a, const PosedShape& b, const Vector3& n_W, const Vector3& p_W);

Vector3 mean_of_supports(const PosedShape& a, const PosedShape& b, const Vector3& n_W);

}  // namespace twinarm
