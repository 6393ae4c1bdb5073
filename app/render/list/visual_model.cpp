// Each connected surface is walked from triangle to triangle across its edges, so that its sides
// come to agree. Each part is welded for its windings and normals; its places in the texture stay
// by corner.
#include "app/render/list/visual_model.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "collision/mesh_files/model_file.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

using Edge = std::pair<int, int>;  // of vertices, ascending

struct Beside {
  std::size_t triangle;
  bool ascending;  // whether it runs along the edge from the lower vertex to the higher
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

class Mender {
 public:
  explicit Mender(TriangleMesh& mesh)
      : mesh_(mesh), beside_(neighbours_of(mesh)), seen_(mesh.triangles.size()) {
    result.turned.resize(mesh.triangles.size());
  }

  MendedWinding result;

  void mend() {
    result.is_closed = !mesh_.triangles.empty();
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
      if (!seen_[i]) mend_surface(i);
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i)
      if (result.turned[i]) std::swap(mesh_.triangles[i][1], mesh_.triangles[i][2]);
  }

 private:
  const Vector3& corner(std::size_t i, std::size_t k) const {
    return mesh_.vertices[static_cast<std::size_t>(mesh_.triangles[i][k])];
  }

  void mend_surface(std::size_t first) {
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
        // They agree where they run along the edge in opposite directions.
        const bool turned = result.turned[i] != (other.ascending == ascending);
        if (seen_[other.triangle]) {
          if (result.turned[other.triangle] != turned) closed = false;  // a Moebius strip
          return;
        }
        seen_[other.triangle] = true;
        result.turned[other.triangle] = turned;
        surface.push_back(other.triangle);
      });
    }
    if (!closed) result.is_closed = false;
    if (closed ? volume(surface) < 0 : area_turned(surface) > 0)
      for (const std::size_t i : surface) result.turned[i] = !result.turned[i];
  }

  // Six times, about the first corner.
  double volume(const std::vector<std::size_t>& surface) const {
    const Vector3 about = corner(surface[0], 0);
    double sum = 0;
    for (const std::size_t i : surface) {
      const Vector3 a = corner(i, 0) - about, b = corner(i, 1) - about, c = corner(i, 2) - about;
      sum += (result.turned[i] ? -1 : 1) * a.dot(b.cross(c));
    }
    return sum;
  }

  // Less that of the others, twice.
  double area_turned(const std::vector<std::size_t>& surface) const {
    double sum = 0;
    for (const std::size_t i : surface) {
      const Vector3 b = corner(i, 1) - corner(i, 0), c = corner(i, 2) - corner(i, 0);
      sum += (result.turned[i] ? 1 : -1) * b.cross(c).norm();
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

// Vertices with equal coordinates are one; triangles that lose a corner by it go.
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

void turn(CornerUv& uv) {
  std::swap(uv[1], uv[2]);
}

VisualMesh visual_of(const ModelPart& part, const Vector3& scale, KeepPlaces keep,
                     std::size_t& turned) {
  Surface surface = weld(part, scale, keep);
  if (scale.prod() < 0) {  // a mirror shows every triangle from behind
    for (auto& t : surface.mesh.triangles) std::swap(t[1], t[2]);
    for (CornerUv& uv : surface.uv) turn(uv);
  }
  const MendedWinding mended = mend_winding(surface.mesh);
  for (std::size_t i = 0; i < surface.uv.size(); ++i)
    if (mended.turned[i]) turn(surface.uv[i]);
  turned += static_cast<std::size_t>(std::ranges::count(mended.turned, true));
  VisualMesh visual;
  visual.mesh = make_draw_mesh(surface.mesh, surface.uv);
  visual.mesh.two_sided = !mended.is_closed;
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

MendedWinding mend_winding(TriangleMesh& mesh) {
  Mender mender(mesh);
  mender.mend();
  return std::move(mender.result);
}

VisualModel load_visual(const std::filesystem::path& file, const Vector3& scale, KeepPlaces keep) {
  const ModelFile model = read_model(file);
  VisualModel visual;
  visual.notes = model.notes;
  const auto pictures = pictures_of(model, visual.notes);
  std::size_t turned = 0;
  for (const ModelPart& part : model.parts) {
    visual.parts.push_back(visual_of(part, scale, keep, turned));
    if (part.texture >= 0)
      visual.parts.back().texture = pictures[static_cast<std::size_t>(part.texture)];
    if (visual.parts.back().mesh.triangles.empty()) visual.parts.pop_back();
  }
  if (visual.parts.empty())
    throw InputError({{file.string(), 0, "mesh", "there is no triangle with an area in it",
                       "export the mesh again", "mesh.no-triangle"}});
  if (turned > 0)
    visual.notes.push_back(std::to_string(turned) +
                           " triangles looked inwards and were turned about");
  return visual;
}

}  // namespace twinarm
