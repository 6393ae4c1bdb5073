#include "collision/shapes/mesh.h"

#include <algorithm>
#include <utility>

namespace twinarm {

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
