#include "collision/shapes/mesh_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "solver/support/number_text.h"

namespace twinarm {
namespace {

constexpr double kDegenerate = 1e-9;  // height over longest side

double six_volumes(const TriangleMesh& mesh) {
  double sum = 0;
  const Vector3 o = mesh.vertices[0];
  for (const auto& [i, j, k] : mesh.triangles)
    sum += (mesh.vertices[i] - o).dot((mesh.vertices[j] - o).cross(mesh.vertices[k] - o));
  return sum;
}

bool is_degenerate(const Vector3& a, const Vector3& b, const Vector3& c) {
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  return !((b - a).cross(c - a).norm() > kDegenerate * longest * longest);
}

// Errors that make the other checks impossible.
std::string index_errors(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return "mesh has no triangles";
  const int count = static_cast<int>(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int v : mesh.triangles[t])
      if (v < 0 || v >= count)
        return "triangle " + std::to_string(t) + " has vertex index " + std::to_string(v) +
               ", the mesh has " + std::to_string(count) + " vertices";
  for (int v = 0; v < count; ++v)
    if (!mesh.vertices[v].allFinite()) return "vertex " + std::to_string(v) + " is not finite";
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
  return std::to_string(count) + " triangles have no area, the first is triangle " +
         std::to_string(first) + ": remove them";
}

std::string duplicate_triangles(const TriangleMesh& mesh) {
  std::vector<std::array<int, 3>> sorted = mesh.triangles;
  for (auto& t : sorted) std::sort(t.begin(), t.end());
  std::sort(sorted.begin(), sorted.end());
  const auto different = std::unique(sorted.begin(), sorted.end()) - sorted.begin();
  const auto count = static_cast<std::ptrdiff_t>(sorted.size()) - different;
  return count == 0 ? "" : std::to_string(count) + " triangles are duplicates: remove them";
}

// Edges without exactly one triangle in each direction.
std::string edge_errors(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, std::pair<int, int>> edges;  // counts by direction
  for (const auto& [a, b, c] : mesh.triangles)
    for (const auto& [i, j] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      ++(i < j ? edges[{i, j}].first : edges[{j, i}].second);
  int open = 0, flipped = 0, many = 0;
  for (const auto& [edge, count] : edges) {
    const int sum = count.first + count.second;
    open += sum == 1, many += sum > 2;
    flipped += sum == 2 && count.first != 1;
  }
  std::string text;
  const auto add = [&](int count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + what;
  };
  add(open, " edges belong to one triangle only (close the holes)");
  add(flipped, " edges have triangles of opposite orientation (flip one of them)");
  add(many, " edges have more than two triangles (split the mesh into parts)");
  return text;
}

}  // namespace

std::string MeshShape::fault() const {
  std::string faults = index_errors(mesh);
  if (!faults.empty()) return faults;
  const auto add = [&](const std::string& fault) {
    if (!fault.empty()) faults += (faults.empty() ? "" : "; ") + fault;
  };
  add(degenerate_triangles(mesh));
  add(duplicate_triangles(mesh));
  const double extent = bounding_box(mesh.vertices).sizes().maxCoeff();
  if (extent > max_extent)
    add("mesh is " + short_number_text(extent) +
        " m wide: for a file in millimetres give scale = 0.001");
  if (is_open) return faults;
  if (!is_closed(mesh)) {
    add("mesh is not closed: " + edge_errors(mesh));
  } else if (!(six_volumes(mesh) > 0)) {
    add("mesh is inverted: orient its triangles counter-clockwise seen from outside");
  }
  return faults;
}

}  // namespace twinarm
