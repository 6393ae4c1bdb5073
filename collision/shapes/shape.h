// Collision shapes, each in its own geometry frame G (its pose is X_WG), and their supports.
//
// Adding one: a struct here, its place in the variant, its support below, and, in polytope.cpp, the
// polytope-with-radius that it is. tests/collision/test_narrow_phase.cpp loops over all pairs.
#pragma once

#include <string>
#include <variant>

#include "collision/shapes/convex_hull.h"
#include "collision/shapes/mesh.h"
#include "solver/spatial/pose.h"

namespace twinarm {

struct Sphere {
  double radius;  // [m], centred
};
struct Box {
  Vector3 size;  // full edge lengths [m], centred, along the axes
};
struct Capsule {
  double radius;  // [m]
  double length;  // between the centres of the two end spheres [m], along z, centred
};
struct Cylinder {
  double radius;  // [m]
  double length;  // [m], along z, centred
};
struct Ellipsoid {
  Vector3 semi_axes;  // half the extents along the axes [m], centred
};
struct HalfSpace {
  Vector3 normal = Vector3::UnitZ();  // outward, unit
  double offset = 0;                  // solid where normal . x <= offset [m]
};
struct HollowSphere {  // the inside: bodies move within
  double radius;       // [m], centred
};
struct HollowCylinder {  // the inside of a tube with open ends
  double radius;         // [m]
  double length;         // [m], along z, centred
};
struct MeshShape {
  TriangleMesh mesh;            // closed, outward; its inside is solid
  bool is_open = false;         // said to have borders: then touched from both sides
  double largest_extent = 100;  // a wider mesh is taken for one in millimetres [m]
};

using Shape = std::variant<Sphere, Box, Capsule, Cylinder, HalfSpace, ConvexHull, Ellipsoid,
                           HollowSphere, HollowCylinder, MeshShape>;

// The point of the shape that lies farthest along `direction` (any length but zero), in G.
// h(d) = max over x of d . x is attained there. Box: 3 comparisons; hull: a scan of the vertices.
// A half-space has none, and gives infinity, except along its own normal. A hollow shape gives that
// of the solid that would fill it.
Vector3 support(const Shape& shape, const Vector3& direction);

// What is wrong with the numbers of a shape, empty if nothing: "radius is -1 m, must be positive".
std::string shape_fault(const Shape& shape);

// "box", "convex hull", ...
std::string shape_name(const Shape& shape);

}  // namespace twinarm
