// The surface of a convex shape in smooth pieces, each with a support function of one line:
//   flat    faces and caps                    one normal
//   ridge   edges, centre lines, cylinder     normals across the line:  h(n) = n . p + radius
//           sides
//   round   corners, rims, ellipsoids         normals all round:  h(n) = n . p + sqrt(n' Q n)
// A spherical rounding is added on top of all of them. For every n the support of the shape is at
// least that of each piece, and equals that of the piece that faces n.
#pragma once

#include <vector>

#include "collision/geometry/polytope.h"
#include "solver/spatial/pose.h"

namespace twinarm {

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
