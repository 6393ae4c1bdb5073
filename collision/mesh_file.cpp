// Meshes through assimp 5.2, and never more of it than needed. The only file that includes assimp.
//
// Measured on mutated files, several of assimp's sixty readers crash or never end; those of STL,
// OBJ and glTF 2 did not. So only these three stay registered, a file is capped in size, and
// whatever comes out is checked as if it were hostile: finite, indices in range, not empty. Welding
// is done here, by equal coordinates. assimp's own JoinIdenticalVertices joins what is closer than
// 1e-5 units, and its FindDegenerates drops triangles below 1e-6 square units: in a file in metres
// those are real edges and real square millimetres. Cost: reading, plus O(n log n) for the welding.
#include "collision/mesh_file.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <map>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/fault.h"

namespace twinarm {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_bytes = 64u << 20;
constexpr const char* formats = "give an STL, OBJ, glTF or GLB file";

[[noreturn]] void refuse(const fs::path& file, const std::string& rule, const std::string& remedy) {
  throw InputError({{file.string(), 0, "mesh", rule, remedy}});
}

// Files of the model's own folder (and below), up to the size cap, for reading only.
class FolderIO : public Assimp::DefaultIOSystem {
 public:
  explicit FolderIO(const fs::path& file) : folder_(fs::weakly_canonical(file).parent_path()) {}

  bool Exists(const char* name) const override {
    return allowed(name) && DefaultIOSystem::Exists(name);
  }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    if (!allowed(name) || mode == nullptr || mode[0] != 'r') return nullptr;
    return DefaultIOSystem::Open(name, mode);
  }

 private:
  bool allowed(const char* name) const {
    std::error_code error;
    const fs::path path = fs::weakly_canonical(name, error);  // follows "..", and links
    if (error) return false;
    const auto [end, unused] =
        std::mismatch(folder_.begin(), folder_.end(), path.begin(), path.end());
    return end == folder_.end() && fs::is_regular_file(path, error) &&
           fs::file_size(path, error) <= max_bytes && !error;
  }
  fs::path folder_;
};

void keep_trusted_readers(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const std::string name = importer.GetImporterInfo(i)->mName;
    if (name.starts_with("Wavefront Object") || name.starts_with("Stereolithography") ||
        name.starts_with("glTF2")) {
      continue;
    }
    Assimp::BaseImporter* const reader = importer.GetImporter(i);
    importer.UnregisterLoader(reader);
    delete reader;  // unregistering hands the ownership over
  }
}

std::string lower_extension(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

void check_file(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) refuse(file, "there is no such file", "check the path");
  if (!fs::is_regular_file(file, error)) refuse(file, "this is not a file", formats);
  const std::string extension = lower_extension(file);
  if (extension != ".stl" && extension != ".obj" && extension != ".gltf" && extension != ".glb") {
    refuse(file, "'" + extension + "' is not a mesh format that is read here", formats);
  }
  if (fs::file_size(file, error) > max_bytes) {
    refuse(file, "the file has more than 64 MiB", "simplify the mesh");
  }
}

// Collects the triangles of all parts, joining vertices with equal coordinates.
class Welder {
 public:
  Welder(const fs::path& file, double scale) : file_(file), scale_(scale) {}

  void add(const aiMesh& part) {
    std::vector<int> welded;
    for (unsigned i = 0; i < part.mNumVertices; ++i) welded.push_back(index_of(part.mVertices[i]));
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      std::array<int, 3> t;
      for (unsigned k = 0; k < 3; ++k) {
        if (face.mIndices[k] >= welded.size()) {
          refuse(file_, "a triangle names a vertex that does not exist", "export the mesh again");
        }
        t[k] = welded[face.mIndices[k]];
      }
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
    }
  }

  TriangleMesh mesh;

 private:
  int index_of(const aiVector3D& v) {
    const Vector3 p = scale_ * Vector3(v.x, v.y, v.z);
    if (!p.allFinite()) {
      refuse(file_, "a coordinate is not a finite number", "export the mesh again");
    }
    // Adding zero makes -0 and 0 the same vertex.
    const auto key = std::tuple(p.x() + 0.0, p.y() + 0.0, p.z() + 0.0);
    const auto [place, is_new] = index_.try_emplace(key, static_cast<int>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(p);
    return place->second;
  }

  const fs::path& file_;
  double scale_;
  std::map<std::tuple<double, double, double>, int> index_;
};

}  // namespace

TriangleMesh load_mesh(const fs::path& file, double scale) {
  if (!(scale > 0 && std::isfinite(scale))) {
    refuse(file, "scale is " + std::to_string(scale) + ", must be positive",
           "give 1 for a file in metres, 0.001 for millimetres");
  }
  check_file(file);
  Assimp::Importer importer;
  keep_trusted_readers(importer);
  importer.SetIOHandler(new FolderIO(file));  // the importer deletes it
  importer.SetPropertyInteger(
      AI_CONFIG_PP_RVC_FLAGS,
      aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_TEXCOORDS |
          aiComponent_COLORS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
          aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS);
  const aiScene* scene = importer.ReadFile(
      file.string(), aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_SortByPType |
                         aiProcess_PreTransformVertices | aiProcess_ValidateDataStructure);
  if (scene == nullptr) {
    refuse(file, std::string("cannot be read: ") + importer.GetErrorString(),
           "check the permissions, or export the mesh again");
  }
  Welder welder(file, scale);
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) welder.add(*scene->mMeshes[i]);
  if (welder.mesh.triangles.empty()) refuse(file, "there is no triangle in it", formats);
  return std::move(welder.mesh);
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
