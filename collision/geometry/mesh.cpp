#include "collision/geometry/mesh.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace twinarm {

Vector3 farthest_along(const std::vector<Vector3>& points, const Vector3& d) {
  std::size_t best = 0;
  double height = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double h = points[i].dot(d);
    if (h > height) {
      height = h;
      best = i;
    }
  }
  return points[best];
}

bool is_closed(const TriangleMesh& mesh) {
  std::vector<std::pair<int, int>> edges;
  for (const auto& [a, b, c] : mesh.triangles) edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
  std::sort(edges.begin(), edges.end());
  const bool once = std::adjacent_find(edges.begin(), edges.end()) == edges.end();
  return !edges.empty() && once && std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    return edge.first != edge.second &&
           std::binary_search(edges.begin(), edges.end(), std::pair(edge.second, edge.first));
  });
}

}  // namespace twinarm
