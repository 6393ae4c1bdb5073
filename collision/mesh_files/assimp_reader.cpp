// Models by assimp 5.2. The only file that includes assimp.
//
// On mutated files several of assimp's sixty readers crash or do not terminate, among them PLY and
// Collada, but not STL, OBJ and glTF 2. So only these five are registered, the file size is
// limited, a child process with limits reads the file (sandboxed_process.h), and the result is
// checked: finite, indices in range, not empty.
// Not used: JoinIdenticalVertices, which merges what is closer than 1e-5 units, and
// FindDegenerates, which drops triangles below 1e-6 square units: in metres those are real edges
// and real square millimetres.
#include "collision/mesh_files/assimp_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <system_error>
#include <utility>

#include "solver/support/text.h"

namespace twinarm {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 5> kReaders = {"Wavefront Object", "Stereolithography", "glTF2",
                                                 "Collada", "Stanford Polygon Library (PLY)"};

// Read-only access to files in the model's folder (and below), up to the size limit.
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
  // The bytes of a file that the model refers to; empty if it does not exist or is not allowed.
  std::optional<std::string> read(std::string name) const {
    std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path path = folder_ / name;
    if (!allowed(path.c_str())) return std::nullopt;
    std::ifstream in(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    return in ? std::optional(std::move(bytes).str()) : std::nullopt;
  }

 private:
  bool allowed(const char* name) const {
    std::error_code error;
    const fs::path path = fs::weakly_canonical(name, error);  // resolves ".." and links
    if (error) return false;
    const auto [end, unused] =
        std::mismatch(folder_.begin(), folder_.end(), path.begin(), path.end());
    return end == folder_.end() && fs::is_regular_file(path, error) &&
           fs::file_size(path, error) <= kMaxModelBytes && !error;
  }
  fs::path folder_;
};

void keep_trusted_readers(Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const std::string name = importer.GetImporterInfo(i)->mName;
    if (std::any_of(kReaders.begin(), kReaders.end(),
                    [&](const char* one) { return name.starts_with(one); }))
      continue;
    Assimp::BaseImporter* const reader = importer.GetImporter(i);
    importer.UnregisterLoader(reader);
    delete reader;  // unregistering transfers the ownership
  }
}

// Linear to sRGB (IEC 61966-2-1): glTF has linear colours, the other formats sRGB.
float srgb(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

// From assimp's scene to a ModelFile.
class AssimpConverter {
 public:
  AssimpConverter(const aiScene& scene, const FolderIO& folder, bool linear_colors)
      : scene_(scene), folder_(folder), linear_(linear_colors) {}

  ModelFile model;

  void add(const aiMesh& mesh) {
    ModelPart part;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D& p = mesh.mVertices[i];
      part.positions.push_back({p.x, p.y, p.z});
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      std::array<std::int32_t, 3> t;
      for (unsigned k = 0; k < 3; ++k) t[k] = static_cast<std::int32_t>(face.mIndices[k]);
      part.triangles.push_back(t);
    }
    if (part.triangles.empty()) return;
    if (mesh.HasTextureCoords(0))
      for (unsigned i = 0; i < mesh.mNumVertices; ++i)
        part.uv.push_back({mesh.mTextureCoords[0][i].x, 1 - mesh.mTextureCoords[0][i].y});
    if (mesh.mMaterialIndex < scene_.mNumMaterials)
      add_material(mesh, *scene_.mMaterials[mesh.mMaterialIndex], part);
    model.parts.push_back(std::move(part));
  }

 private:
  void add_material(const aiMesh& mesh, const aiMaterial& material, ModelPart& part) {
    aiString name;
    if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS &&
        std::string(name.C_Str()) == AI_DEFAULT_MATERIAL_NAME)
      return;  // assimp's default: the file has none
    aiColor4D c;
    if (material.Get(AI_MATKEY_COLOR_DIFFUSE, c) == aiReturn_SUCCESS) {
      part.has_color = 1;
      float opacity = c.a;
      material.Get(AI_MATKEY_OPACITY, opacity);
      part.color = {c.r, c.g, c.b, opacity};
      for (std::size_t k = 0; k < 4; ++k) {
        if (linear_ && k < 3) part.color[k] = srgb(part.color[k]);
        part.color[k] = std::isfinite(part.color[k]) ? std::clamp(part.color[k], 0.0f, 1.0f) : 1;
      }
    }
    aiString texture;
    if (mesh.HasTextureCoords(0) &&
        material.GetTexture(aiTextureType_DIFFUSE, 0, &texture) == aiReturn_SUCCESS)
      part.texture = texture_of(texture.C_Str());
  }

  std::int32_t texture_of(const std::string& name) {
    const auto [at, is_new] = texture_.try_emplace(name, -1);
    if (!is_new) return at->second;
    const aiTexture* const inside = scene_.GetEmbeddedTexture(name.c_str());
    std::optional<std::string> bytes;
    if (inside && inside->mHeight == 0)  // embedded file of mWidth bytes
      bytes = std::string(reinterpret_cast<const char*>(inside->pcData), inside->mWidth);
    else if (!inside)
      bytes = folder_.read(name);
    if (!bytes) {
      model.notes.push_back("texture '" + name + "' does not exist in the model's folder");
      return -1;
    }
    model.textures.push_back({name, std::move(*bytes)});
    return at->second = static_cast<std::int32_t>(model.textures.size()) - 1;
  }

  const aiScene& scene_;
  const FolderIO& folder_;
  bool linear_;
  std::map<std::string, std::int32_t> texture_;
};

std::string read_packed(const std::string& name) {
  const fs::path file = name;
  Assimp::Importer importer;
  keep_trusted_readers(importer);
  auto* const folder = new FolderIO(file);
  importer.SetIOHandler(folder);  // the importer deletes it
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_BONEWEIGHTS |
                                  aiComponent_ANIMATIONS | aiComponent_LIGHTS |
                                  aiComponent_CAMERAS);
  const aiScene* scene = importer.ReadFile(
      name, aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_SortByPType |
                aiProcess_PreTransformVertices | aiProcess_ValidateDataStructure);
  if (scene == nullptr) return std::string("!") + importer.GetErrorString();
  const std::string extension = lower_case(file.extension().string());
  AssimpConverter converter(*scene, *folder, extension == ".gltf" || extension == ".glb");
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) converter.add(*scene->mMeshes[i]);
  return " " + packed(std::move(converter.model));
}

}  // namespace
}  // namespace twinarm

twinarm::ChildWork twinarm_assimp_reader() {
  return twinarm::read_packed;
}
