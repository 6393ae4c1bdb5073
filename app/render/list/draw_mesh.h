// DrawMesh: triangles with a normal at each vertex, as every painter needs them; how to make one
// from a TriangleMesh; and the unit shapes of which overlays are built.
//
// Each mesh lives in a frame M of its own; an instance places, turns and scales it (draw_list.h).
// Single precision: painters draw with it, and a web page receives half the bytes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "collision/geometry/mesh.h"
#include "solver/spatial/pose.h"

namespace twinarm {

struct DrawMesh {
  std::vector<std::array<float, 3>> positions;  // in M [m]
  std::vector<std::array<float, 3>> normals;    // in M, unit length, one per position
  std::vector<std::array<float, 2>> uv;         // in a texture, one per position; empty: none
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
  bool two_sided = false;                               // an open surface, to be seen from within

  // A sphere that holds the mesh, in M [m]: painters fit shadows and depth range with it.
  Vector3 bound_center = Vector3::Zero();
  double bound_radius = 0;
};

// In M; empty for a mesh without vertices.
Eigen::AlignedBox3d bounding_box(const DrawMesh& mesh);

// Edges whose two facets turn by less than this are drawn round, others sharp.
inline constexpr double kCreaseAngle = 35.0 * 3.14159265358979323846 / 180.0;

// Vertices at the same place are welded first (STL gives each facet its own). The normal of a
// triangle's corner is the mean of the facets around that vertex that lie within the crease angle
// of the triangle, weighted by their area and their angle there: the large flat faces of a casting
// then stay flat to the eye, and its small fillets take up the whole turn. Facets without area are
// dropped. Cost: the sum of squared valences, of which those beyond 512 count once.
//
// `uv`: where each corner of each triangle lies in a texture, (0, 0) at its top left and (1, 1) at
// its bottom right; empty for none.
using CornerUv = std::array<std::array<float, 2>, 3>;
DrawMesh make_draw_mesh(const TriangleMesh& mesh, const std::vector<CornerUv>& uv = {});

enum class UnitShape {
  box,       // edge 1, centred
  sphere,    // radius 1, centred
  cylinder,  // radius 1, axis z from 0 to 1
  cone,      // base radius 1 at z = 0, tip at z = 1
};
// With places in a texture (below), but for the cone.
DrawMesh make_unit_mesh(UnitShape shape);

// A helical spring along z from 0 to 1, coil radius 1, with straight leads on the axis. Stretching
// it to its place would also stretch its wire; so the wire is drawn flat in such a way that it is
// round again when the spring is scaled to `aspect` = length / coil radius.
DrawMesh make_unit_spring(double aspect);

// Where the corners of plain shapes lie in a texture, (0, 0) at its top left, (1, 1) at its bottom
// right. World or body axes: z up.
//
// Of a box of edge 1, centred: each face shows the whole picture. Of the four at the sides up is z,
// of top and bottom y.
std::vector<CornerUv> places_on_box(const TriangleMesh& box);

// The picture once around z, its left and right border where y = 0 and x < 0; `down` gives how far
// below its upper border a point lies. Facets that look along z show the circle of radius `cap`
// within the picture; 0: there are none.
std::vector<CornerUv> places_around_z(const TriangleMesh& mesh,
                                      const std::function<double(const Vector3&)>& down,
                                      double cap = 0);

}  // namespace twinarm
