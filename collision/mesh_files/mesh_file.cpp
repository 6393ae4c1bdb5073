// All parts of a model in one mesh; vertices with equal coordinates are merged. O(n).
#include "collision/mesh_files/mesh_file.h"

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "collision/mesh_files/model_file.h"
#include "solver/support/diagnostics.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

class Welder {
 public:
  explicit Welder(double scale) : scale_(scale) {}

  void add(const ModelPart& part) {
    std::vector<int> welded;
    for (const auto& p : part.positions) welded.push_back(index_of(p));
    for (const auto& [a, b, c] : part.triangles) {
      const auto at = [&](std::int32_t i) { return welded[static_cast<std::size_t>(i)]; };
      const std::array<int, 3> t{at(a), at(b), at(c)};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
    }
  }

  TriangleMesh mesh;

 private:
  int index_of(const std::array<float, 3>& v) {
    const Vector3 p = scale_ * Vector3(v[0], v[1], v[2]);
    // Adding zero makes -0 and 0 the same vertex.
    const std::array<double, 3> key{p.x() + 0.0, p.y() + 0.0, p.z() + 0.0};
    const auto [at, is_new] = index_.try_emplace(key, static_cast<int>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(p);
    return at->second;
  }

  double scale_;
  struct HashOfBytes {
    std::size_t operator()(const std::array<double, 3>& p) const {
      return std::hash<std::string_view>()({reinterpret_cast<const char*>(p.data()), sizeof p});
    }
  };
  std::unordered_map<std::array<double, 3>, int, HashOfBytes> index_;
};

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& file, double scale) {
  const auto refuse = [&](const std::string& problem, const std::string& fix) {
    throw InputError({{file.string(), 0, "mesh", problem, fix, "mesh.file"}});
  };
  if (!(scale > 0 && std::isfinite(scale)))
    refuse("scale is " + short_number_text(scale) + ", must be positive",
           "give 1 for a file in metres, 0.001 for millimetres");
  Welder welder(scale);
  for (const ModelPart& part : read_model(file).parts) welder.add(part);
  if (welder.mesh.triangles.empty())
    refuse("the mesh has no triangle with three different vertices", "export the mesh again");
  return std::move(welder.mesh);
}

}  // namespace twinarm
