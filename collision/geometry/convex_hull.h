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
  Vector3 support(const Vector3& d) const { return max_along(vertices, d); }
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

// Shapes as polytopes with a radius, which makes one exact narrow phase of most pairs:
//   sphere = point + r, capsule = segment + r, box and hull = polyhedron + 0,
// so that depth(A, B) = r_A + r_B - signed distance of the cores. Cylinders, ellipsoids:
// Patches below.
struct Polytope {
  struct Edge {
    int v0, v1;  // its ends
    int f0, f1;  // the faces on both sides; -1 for a bare segment
  };
  struct Slab {  // a face, and the parallel one opposite if there is one
    Vector3 normal;
    double low, high;  // solid where low <= normal . x <= high [m]
    bool is_double;    // false: no face at `low`
  };
  ConvexHull hull;  // of a point or a segment: vertices only
  std::vector<Edge> edges;
  std::vector<Slab> slabs;
  double radius = 0;   // [m]
  bool exists = true;  // false for curved shapes and half-spaces
  VertexTable table;   // of the hull's vertices, where they are more than a few

  // The vertex that is farthest along d, in the body's frame.
  int farthest(const Vector3& d) const;
};

// With its edges and slabs.
Polytope polyhedron(ConvexHull hull);

// The box as a hull: 8 vertices, 6 faces.
ConvexHull box_hull(const Vector3& size);

// The surface of a convex shape in smooth pieces, each with a support function of one line:
//   flat    faces and caps                    one normal
//   ridge   edges, centre lines, cylinder     normals across the line:  h(n) = n . p + radius
//           sides
//   round   corners, rims, ellipsoids         normals all round:  h(n) = n . p + sqrt(n' Q n)
// A spherical rounding is added on top of all of them. For every n the support of the shape is at
// least that of each piece, and equals that of the piece that faces n.
struct Patches {
  struct Ridge {
    Vector3 start, end;  // [m]
    double radius;       // of a cylinder's side, else 0 [m]
  };
  struct Round {
    Vector3 p;  // centre [m]
    Matrix3 Q;  // square of the half axes, zero for a corner [m^2]
  };
  std::vector<Vector3> flats;  // outward unit normals
  std::vector<Ridge> ridges;   // of a polytope: its edges, in their order
  std::vector<Round> rounds;   // of a polytope: its corners, in their order
  double roundness = 0;        // [m]
  double sharpest = 1e300;  // of a curved body: least radius of curvature, or half a thickness [m]
};

// In the frame of the core; empty where it does not exist.
inline Patches make_patches(const Polytope& core) {
  Patches patches;
  if (!core.exists) return patches;
  const std::vector<Vector3>& vertices = core.hull.vertices;
  patches.flats = core.hull.normals;
  for (const Polytope::Edge& edge : core.edges) {
    patches.ridges.push_back({vertices[edge.v0], vertices[edge.v1], 0});
  }
  for (const Vector3& v : vertices) patches.rounds.push_back({v, Matrix3::Zero()});
  patches.roundness = core.radius;
  return patches;
}

}  // namespace twinarm
