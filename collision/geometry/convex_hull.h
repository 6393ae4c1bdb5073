// Convex hull of a set of points: vertices, outward planes, and the polygons that lie in them.
//
// A flat side is ONE polygon, not a fan of coplanar triangles: contact manifolds are clipped
// against whole sides, and the number of separating axes is the number of different normals.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "collision/geometry/mesh.h"
#include "solver/spatial/pose.h"

namespace twinarm {

struct MassProperties;
struct Polytope;

// A convex polyhedron in the frame of the points that it was made from. [m]
struct ConvexHull {
  std::vector<Vector3> vertices;
  std::vector<std::vector<int>> faces;        // loops of vertices, counter-clockwise from outside
  std::vector<Vector3> normals;               // of each face, unit, outward
  std::vector<double> offsets;                // of each face: inside is normal . x <= offset
  std::vector<std::array<int, 3>> triangles;  // the faces cut into fans

  // As a shape (collision/shapes/shape.h).
  static constexpr const char* name = "convex hull";
  Vector3 support(const Vector3& d) const { return farthest_along(vertices, d); }
  std::string fault() const;
  MassProperties solid(double density) const;
  Polytope polytope() const;
};

// Throws InputError where the points span no volume (fewer than 4, all in a plane, not finite).
// Facets whose planes agree to `flatness` times the extent of the points become one polygon; the
// default is what the coordinates of a single-precision mesh file scatter.
ConvexHull convex_hull(std::span<const Vector3> points, double flatness = 1e-7);

// Fills `normals`, `offsets` and `triangles` from `vertices` and `faces`.
void complete_faces(ConvexHull& hull);

}  // namespace twinarm
