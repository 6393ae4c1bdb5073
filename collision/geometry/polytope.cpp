// Edges and slabs of a polyhedron. See polytope.h.
#include "collision/geometry/polytope.h"

#include <map>
#include <utility>

namespace twinarm {
namespace {

std::vector<Polytope::Slab> slabs_of(const ConvexHull& hull) {
  std::vector<Polytope::Slab> slabs;
  std::vector<bool> is_done(hull.normals.size(), false);
  for (std::size_t f = 0; f < hull.normals.size(); ++f) {
    if (is_done[f]) continue;
    const Vector3& n = hull.normals[f];
    slabs.push_back({n, 0, hull.offsets[f], false});
    for (std::size_t g = f + 1; g < hull.normals.size() && !slabs.back().is_double; ++g) {
      if (hull.normals[g] != -n) continue;
      slabs.back() = {n, -hull.offsets[g], hull.offsets[f], true};
      is_done[g] = true;
    }
  }
  return slabs;
}

}  // namespace

// Finds the edges of a polyhedron: each is walked once by either of its two faces.
Polytope polyhedron(ConvexHull hull) {
  Polytope polytope;
  std::map<std::pair<int, int>, int> face_of;  // directed edge -> face that walks it
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    const std::vector<int>& loop = hull.faces[f];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      face_of[{loop[i], loop[(i + 1) % loop.size()]}] = static_cast<int>(f);
    }
  }
  for (const auto& [edge, face] : face_of) {
    const auto twin = face_of.find({edge.second, edge.first});
    if (edge.first < edge.second && twin != face_of.end()) {
      polytope.edges.push_back({edge.first, edge.second, face, twin->second});
    }
  }
  polytope.slabs = slabs_of(hull);
  polytope.hull = std::move(hull);
  constexpr std::size_t few = 64;  // are as soon asked one by one
  if (polytope.hull.vertices.size() > few) polytope.table = VertexTable(polytope.hull.vertices);
  return polytope;
}

int Polytope::farthest(const Vector3& d) const {
  if (!table.empty()) return static_cast<int>(table.farthest(d));
  int best = 0;
  double height = hull.vertices[0].dot(d);
  for (std::size_t i = 1; i < hull.vertices.size(); ++i) {
    const double h = hull.vertices[i].dot(d);
    if (h > height) best = static_cast<int>(i), height = h;
  }
  return best;
}

Polytope ConvexHull::polytope() const {
  return polyhedron(*this);
}

ConvexHull box_hull(const Vector3& size) {
  ConvexHull hull;
  for (int i = 0; i < 8; ++i) {  // bit k of i: the side along axis k
    const Vector3 sides(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    hull.vertices.push_back(0.5 * sides.cwiseProduct(size));
  }
  hull.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  complete_faces(hull);
  return hull;
}

}  // namespace twinarm
