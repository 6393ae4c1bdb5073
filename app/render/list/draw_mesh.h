// DrawMesh: triangles with vertex normals in a mesh frame M, made from a TriangleMesh; unit shapes
// of overlays. Single precision, as drawn and as sent to web pages.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "collision/geometry/mesh.h"
#include "solver/spatial/pose.h"

namespace twinarm {

struct DrawMesh {
  std::vector<std::array<float, 3>> positions;          // in M [m]
  std::vector<std::array<float, 3>> normals;            // in M, unit length, one per position
  std::vector<std::array<float, 2>> uv;                 // one per position; empty: none
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
  bool two_sided = false;                               // an open surface

  // Bounding sphere in M [m], for shadows and depth range.
  Vector3 bound_center = Vector3::Zero();
  double bound_radius = 0;
};

// In M; empty for a mesh without vertices.
Eigen::AlignedBox3d bounding_box(const DrawMesh& mesh);

// Edges below this angle are drawn smooth, others sharp.
inline constexpr double kCreaseAngle = 35.0 * 3.14159265358979323846 / 180.0;

// Welds equal vertices first (STL repeats them). The normal of a triangle's corner is the mean
// normal of the facets at that vertex within the crease angle of the triangle, weighted by area and
// corner angle. Facets without area are dropped. Cost: sum of squared valences up to 512.
//
// `uv`: texture coordinates by corner of each triangle, (0, 0) top left, (1, 1) bottom right; empty
// for none.
using CornerUv = std::array<std::array<float, 2>, 3>;
DrawMesh make_draw_mesh(const TriangleMesh& mesh, const std::vector<CornerUv>& uv = {});

enum class UnitShape {
  box,            // edge 1, centred
  sphere,         // radius 1, centred
  coarse_sphere,  // the same with a sixth of the triangles
  cylinder,       // radius 1, axis z from 0 to 1
  cone,           // base radius 1 at z = 0, tip at z = 1
};
// With texture coordinates (below), except the cone.
DrawMesh make_unit_mesh(UnitShape shape);

// Surface of revolution about z of a profile (radius, z), upwards; open at its ends.
TriangleMesh surface_of_revolution(const std::vector<Eigen::Vector2d>& profile);

// A helical spring along z from 0 to 1, coil radius 1, with straight ends on the axis. Its wire is
// flattened so that it is round when the spring is scaled to `aspect` = length / coil radius.
DrawMesh make_unit_spring(double aspect);

// Texture coordinates of plain shapes, z up.
//
// Of a centred box of edge 1: each face shows the whole texture, upwards z, on top and bottom y.
std::vector<CornerUv> places_on_box(const TriangleMesh& box);

// The texture once around z, its left and right border at y = 0, x < 0; `down`: v of a point.
// Facets normal to z show the circle of radius `cap` within the texture; 0: there are none.
std::vector<CornerUv> places_around_z(const TriangleMesh& mesh,
                                      const std::function<double(const Vector3&)>& down,
                                      double cap = 0);

}  // namespace twinarm
