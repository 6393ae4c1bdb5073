// Convex hulls and polytopes.
//
// A face is one polygon, not a fan of coplanar triangles: manifolds are clipped against whole
// faces, and there is one separating axis for each normal.
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

// A convex polyhedron in the frame of its input points [m].
struct ConvexHull {
  std::vector<Vector3> vertices;
  std::vector<std::vector<int>> faces;        // vertex loops, counter-clockwise from outside
  std::vector<Vector3> normals;               // by face: unit, outward
  std::vector<double> offsets;                // by face: inside is normal . x <= offset
  std::vector<std::array<int, 3>> triangles;  // triangulated faces

  // Interface of a shape (collision/shapes/shape.h).
  static constexpr const char* name = "convex hull";
  Vector3 support(const Vector3& d) const { return support_point(vertices, d); }
  std::string fault() const;
  MassProperties solid(double density) const;
  Polytope polytope() const;  // with its edges and slabs
};

// Throws InputError if the points span no volume (fewer than 4, coplanar, not finite). Facets whose
// planes agree to `flatness` times the extent are merged; the default is the rounding of
// single-precision mesh files.
ConvexHull convex_hull(std::span<const Vector3> points, double flatness = 1e-7);

// Shapes as polytopes with a radius: sphere = point + r, capsule = segment + r, box and hull =
// polyhedron + 0, so that depth(A, B) = r_A + r_B - signed distance of the cores. Cylinders and
// ellipsoids: BoundaryFeatures.
struct Polytope {
  struct Edge {
    int v0, v1;  // vertices
    int f0, f1;  // adjacent faces; -1 for a segment
  };
  struct Slab {  // a face, with the opposite parallel face if there is one
    Vector3 normal;
    double low, high;  // solid where low <= normal . x <= high [m]
    bool is_double;    // false: no face at `low`
  };
  ConvexHull hull;  // point and segment: vertices only
  std::vector<Edge> edges;
  std::vector<Slab> slabs;
  double radius = 0;      // [m]
  bool exists = true;     // false for curved shapes and half-spaces
  SupportVertices table;  // for hulls with many vertices

  // Index of the support vertex in direction d (body frame).
  int support_index(const Vector3& d) const;
};

ConvexHull box_hull(const Vector3& size);

// The boundary of a convex shape as smooth features, each with its support function:
//   face       faces and caps                      one normal
//   line       edges, cylinder sides and axes      normals perpendicular to it: h(n) = n . p +
//   radius quadric    vertices, rims, ellipsoids          all normals:  h(n) = n . p + sqrt(n' Q n)
// A spherical rounding is added to all of them. For every n the support of the shape is at least
// that of each feature, and equals that of the feature with normal n.
struct BoundaryFeatures {
  struct Line {
    Vector3 start, end;  // [m]
    double radius;       // of a cylinder, else 0 [m]
  };
  struct Quadric {
    Vector3 p;  // centre [m]
    Matrix3 Q;  // squared semi-axes, zero for a vertex [m^2]
  };
  std::vector<Vector3> face_normals;  // outward, unit
  std::vector<Line> lines;            // of a polytope: its edges, in their order
  std::vector<Quadric> quadrics;      // of a polytope: its vertices, in their order
  double rounding_radius = 0;         // [m]
  double min_radius = 1e300;          // minimum radius of curvature or half thickness [m]
};

// Empty if the core does not exist.
inline BoundaryFeatures make_boundary(const Polytope& core) {
  BoundaryFeatures boundary;
  if (!core.exists) return boundary;
  const std::vector<Vector3>& vertices = core.hull.vertices;
  boundary.face_normals = core.hull.normals;
  for (const Polytope::Edge& edge : core.edges)
    boundary.lines.push_back({vertices[edge.v0], vertices[edge.v1], 0});
  for (const Vector3& v : vertices) boundary.quadrics.push_back({v, Matrix3::Zero()});
  boundary.rounding_radius = core.radius;
  return boundary;
}

}  // namespace twinarm
