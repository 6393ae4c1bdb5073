// All parts of a model in one mesh; vertices with equal coordinates are merged. O(n).
#include "collision/mesh_files/mesh_file.h"

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "collision/mesh_files/model_file.h"
#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

struct HashOfBytes {
  std::size_t operator()(const std::array<double, 3>& p) const {
    return std::hash<std::string_view>()({reinterpret_cast<const char*>(p.data()), sizeof p});
  }
};

TriangleMesh welded(const std::vector<ModelPart>& parts, double scale) {
  TriangleMesh mesh;
  std::unordered_map<std::array<double, 3>, int, HashOfBytes> known;
  for (const ModelPart& part : parts) {
    std::vector<int> merged;  // by vertex of the part
    for (const auto& v : part.positions) {
      const Vector3 p = scale * Vector3(v[0], v[1], v[2]);
      // Adding zero makes -0 and 0 the same vertex.
      const std::array<double, 3> key{p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
      const auto [at, is_new] = known.try_emplace(key, static_cast<int>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(p);
      merged.push_back(at->second);
    }
    for (const auto& [a, b, c] : part.triangles) {
      const auto at = [&](std::int32_t i) { return merged[static_cast<std::size_t>(i)]; };
      const std::array<int, 3> t{at(a), at(b), at(c)};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& file, double scale) {
  const auto refuse = [&](const std::string& problem, const std::string& fix) {
    throw InputError({{file.string(), 0, "mesh", problem, fix, "mesh.file"}});
  };
  if (!(scale > 0 && std::isfinite(scale)))
    refuse("scale is " + short_number_text(scale) + ", must be positive",
           "give 1 for a file in metres, 0.001 for millimetres");
  TriangleMesh mesh = welded(read_model(file).parts, scale);
  if (mesh.triangles.empty())
    refuse("the mesh has no triangle with three different vertices", "export the mesh again");
  return mesh;
}

}  // namespace twinarm
