// Breadth-first over each connected surface, across its edges. Texture coordinates stay by corner.
#include "app/render/list/visual_model.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "collision/mesh_files/model_file.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

using Edge = std::pair<int, int>;  // of vertices, ascending

struct Beside {
  std::size_t triangle;
  bool ascending;  // direction of the triangle along the edge: from the lower vertex
};
using Neighbours = std::map<Edge, std::vector<Beside>>;

template <class Visit>
void visit_edges(const std::array<int, 3>& t, Visit visit) {
  for (std::size_t k = 0; k < 3; ++k) {
    const int a = t[k], b = t[(k + 1) % 3];
    visit(Edge(std::min(a, b), std::max(a, b)), a < b);
  }
}

Neighbours neighbours_of(const TriangleMesh& mesh) {
  Neighbours beside;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    visit_edges(mesh.triangles[i], [&](const Edge& edge, bool ascending) {
      beside[edge].push_back({i, ascending});
    });
  return beside;
}

class WindingRepair {
 public:
  explicit WindingRepair(TriangleMesh& mesh)
      : mesh_(mesh), beside_(neighbours_of(mesh)), seen_(mesh.triangles.size()) {
    result.flipped.resize(mesh.triangles.size());
    result.is_closed = !mesh_.triangles.empty();
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
      if (!seen_[i]) repair_surface(i);
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
      if (result.flipped[i]) std::swap(mesh_.triangles[i][1], mesh_.triangles[i][2]);
  }

  ConsistentWinding result;

 private:
  const Vector3& corner(std::size_t i, std::size_t k) const {
    return mesh_.vertices[static_cast<std::size_t>(mesh_.triangles[i][k])];
  }

  void repair_surface(std::size_t first) {
    std::vector<std::size_t> surface{first};
    seen_[first] = true;
    bool closed = true;
    for (std::size_t next = 0; next < surface.size(); ++next) {  // grows while it is walked
      const std::size_t i = surface[next];
      visit_edges(mesh_.triangles[i], [&](const Edge& edge, bool ascending) {
        const std::vector<Beside>& both = beside_.at(edge);
        if (both.size() != 2) {
          closed = false;
          return;
        }
        const Beside& other = both[both[0].triangle == i ? 1 : 0];
        // Consistent: opposite directions along the edge.
        const bool flipped = result.flipped[i] != (other.ascending == ascending);
        if (seen_[other.triangle]) {
          if (result.flipped[other.triangle] != flipped) closed = false;  // a Moebius strip
          return;
        }
        seen_[other.triangle] = true;
        result.flipped[other.triangle] = flipped;
        surface.push_back(other.triangle);
      });
    }
    if (!closed) result.is_closed = false;
    if (closed ? volume(surface) < 0 : flipped_area(surface) > 0)
      for (const std::size_t i : surface) result.flipped[i] = !result.flipped[i];
  }

  // Six times the volume.
  double volume(const std::vector<std::size_t>& surface) const {
    const Vector3 about = corner(surface[0], 0);
    double sum = 0;
    for (const std::size_t i : surface) {
      const Vector3 a = corner(i, 0) - about, b = corner(i, 1) - about, c = corner(i, 2) - about;
      sum += (result.flipped[i] ? -1 : 1) * a.dot(b.cross(c));
    }
    return sum;
  }

  // Twice the area of flipped triangles minus that of the others.
  double flipped_area(const std::vector<std::size_t>& surface) const {
    double sum = 0;
    for (const std::size_t i : surface) {
      const Vector3 b = corner(i, 1) - corner(i, 0), c = corner(i, 2) - corner(i, 0);
      sum += (result.flipped[i] ? 1 : -1) * b.cross(c).norm();
    }
    return sum;
  }

  TriangleMesh& mesh_;
  Neighbours beside_;
  std::vector<bool> seen_;
};

struct Surface {
  TriangleMesh mesh;
  std::vector<CornerUv> uv;
};

// Merges equal vertices; drops triangles that degenerate.
Surface weld(const ModelPart& part, const Vector3& scale, KeepPlaces keep) {
  Surface surface;
  const bool has_uv = !part.uv.empty() && (part.texture >= 0 || keep == KeepPlaces::always);
  std::map<std::tuple<float, float, float>, int> index;
  std::vector<int> welded;
  for (const auto& [x, y, z] : part.positions) {
    const int next = static_cast<int>(surface.mesh.vertices.size());
    const auto [place, is_new] = index.try_emplace({x + 0.0f, y + 0.0f, z + 0.0f}, next);
    if (is_new) surface.mesh.vertices.push_back(scale.cwiseProduct(Vector3(x, y, z)));
    welded.push_back(place->second);
  }
  for (const auto& triangle : part.triangles) {
    std::array<int, 3> t;
    CornerUv uv{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(triangle[k]);
      t[k] = welded[v];
      if (has_uv) uv[k] = part.uv[v];
    }
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    surface.mesh.triangles.push_back(t);
    if (has_uv) surface.uv.push_back(uv);
  }
  return surface;
}

VisualMesh visual_of(const ModelPart& part, const Vector3& scale, KeepPlaces keep,
                     std::size_t& flipped) {
  Surface surface = weld(part, scale, keep);
  if (scale.prod() < 0) {  // mirrored
    for (auto& t : surface.mesh.triangles) std::swap(t[1], t[2]);
    for (CornerUv& uv : surface.uv) std::swap(uv[1], uv[2]);
  }
  const ConsistentWinding winding = make_winding_consistent(surface.mesh);
  for (std::size_t i = 0; i < surface.uv.size(); ++i)
    if (winding.flipped[i]) std::swap(surface.uv[i][1], surface.uv[i][2]);
  flipped += static_cast<std::size_t>(std::ranges::count(winding.flipped, true));
  VisualMesh visual;
  visual.mesh = make_draw_mesh(surface.mesh, surface.uv);
  visual.mesh.two_sided = !winding.is_closed;
  if (part.has_color != 0)
    visual.color = Color{part.color[0], part.color[1], part.color[2], part.color[3]};
  return visual;
}

std::vector<std::shared_ptr<const Image>> pictures_of(const ModelFile& model,
                                                      std::vector<std::string>& notes) {
  std::vector<std::shared_ptr<const Image>> pictures;
  for (const ModelTexture& texture : model.textures) {
    pictures.emplace_back();
    try {
      pictures.back() = std::make_shared<const Image>(decode_image(texture.name, texture.bytes));
    } catch (const InputError& error) {
      notes.push_back("texture '" + texture.name + "' " + error.faults().at(0).problem);
    }
  }
  return pictures;
}

}  // namespace

ConsistentWinding make_winding_consistent(TriangleMesh& mesh) {
  return WindingRepair(mesh).result;
}

VisualModel load_visual(const std::filesystem::path& file, const Vector3& scale, KeepPlaces keep) {
  const ModelFile model = read_model(file);
  VisualModel visual;
  visual.notes = model.notes;
  const auto pictures = pictures_of(model, visual.notes);
  std::size_t flipped = 0;
  for (const ModelPart& part : model.parts) {
    visual.parts.push_back(visual_of(part, scale, keep, flipped));
    if (part.texture >= 0)
      visual.parts.back().texture = pictures[static_cast<std::size_t>(part.texture)];
    if (visual.parts.back().mesh.triangles.empty()) visual.parts.pop_back();
  }
  if (visual.parts.empty())
    throw InputError({{file.string(), 0, "mesh", "it has no triangle with an area",
                       "export the mesh again", "mesh.no-triangle"}});
  if (flipped > 0)
    visual.notes.push_back(std::to_string(flipped) + " triangles faced inwards and were flipped");
  return visual;
}

}  // namespace twinarm
