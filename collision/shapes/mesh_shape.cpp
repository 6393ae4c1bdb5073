// Checks of a mesh that is to be collided with.
#include "collision/shapes/mesh_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace twinarm {
namespace {

// Thinner than this share of its longest side, a triangle has no normal worth the name.
constexpr double degenerate = 1e-9;

double six_volumes(const TriangleMesh& mesh) {
  double sum = 0;
  const Vector3 o = mesh.vertices[0];
  for (const auto& [i, j, k] : mesh.triangles) {
    sum += (mesh.vertices[i] - o).dot((mesh.vertices[j] - o).cross(mesh.vertices[k] - o));
  }
  return sum;
}

bool is_degenerate(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  return !((b - a).cross(c - a).norm() > degenerate * longest * longest);
}

// What would make any further check meaningless.
std::string broken(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return "mesh has no triangles";
  const int count = static_cast<int>(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int v : mesh.triangles[t]) {
      if (v < 0 || v >= count) {
        return "triangle " + std::to_string(t) + " names corner " + std::to_string(v) + " of " +
               std::to_string(count);
      }
    }
  }
  for (int v = 0; v < count; ++v) {
    if (!mesh.vertices[v].allFinite()) return "corner " + std::to_string(v) + " is not finite";
  }
  return "";
}

std::string degenerate_triangles(const TriangleMesh& mesh) {
  std::size_t count = 0, first = 0;
  for (std::size_t t = mesh.triangles.size(); t-- > 0;) {
    const auto& [i, j, k] = mesh.triangles[t];
    if (!is_degenerate(mesh.vertices[i], mesh.vertices[j], mesh.vertices[k])) continue;
    ++count;
    first = t;
  }
  if (count == 0) return "";
  return std::to_string(count) + " triangles have no area, the first is number " +
         std::to_string(first) + ": remove them";
}

std::string twins(const TriangleMesh& mesh) {
  std::vector<std::array<int, 3>> sorted = mesh.triangles;
  for (auto& t : sorted) std::sort(t.begin(), t.end());
  std::sort(sorted.begin(), sorted.end());
  const auto different = std::unique(sorted.begin(), sorted.end()) - sorted.begin();
  const auto count = static_cast<std::ptrdiff_t>(sorted.size()) - different;
  return count == 0 ? "" : std::to_string(count) + " triangles are there twice: remove them";
}

// Edges of one triangle alone, and edges that two triangles run along in the same direction.
std::string borders(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, std::pair<int, int>> edges;  // low, high: how often each way
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& [i, j] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      ++(i < j ? edges[{i, j}].first : edges[{j, i}].second);
  int open = 0, turned = 0, many = 0;
  for (const auto& [edge, count] : edges) {
    const int sum = count.first + count.second;
    open += sum == 1, many += sum > 2;
    turned += sum == 2 && count.first != 1;
  }
  std::string text;
  const auto add = [&](int count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + what;
  };
  add(open, " edges belong to one triangle alone (close the holes)");
  add(turned, " edges have triangles that disagree which side is outside (turn them about)");
  add(many, " edges have more than two triangles (take the parts in turn, or cut them apart)");
  return text;
}

}  // namespace

std::string MeshShape::fault() const {
  std::string faults = broken(mesh);
  if (!faults.empty()) return faults;
  const auto add = [&](const std::string& fault) {
    if (!fault.empty()) faults += (faults.empty() ? "" : "; ") + fault;
  };
  add(degenerate_triangles(mesh));
  add(twins(mesh));
  Vector3 low = mesh.vertices[0], high = low;
  for (const Vector3& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const double extent = (high - low).maxCoeff();
  if (extent > max_extent) {
    add("mesh is " + std::to_string(extent) +
        " m wide: read a file in millimetres with scale = 0.001");
  }
  if (is_open) return faults;
  if (!is_closed(mesh)) {
    add("mesh is not closed: " + borders(mesh));
  } else if (!(six_volumes(mesh) > 0)) {
    add("mesh is inside out: turn its triangles counter-clockwise seen from outside");
  }
  return faults;
}

}  // namespace twinarm
