// Models through assimp 5.2, and never more of it than needed. The only file that includes assimp.
//
// Measured on mutated files, several of assimp's sixty readers crash or never end: those of PLY and
// Collada among them, those of STL, OBJ and glTF 2 not. So only these five stay registered, a file
// is capped in size, the reading is done in a child process with limits (sandboxed_process.h), and
// whatever comes out is checked as if it were hostile: finite, indices in range, not empty.
// Not used: JoinIdenticalVertices, which joins what is closer than 1e-5 units, and FindDegenerates,
// which drops triangles below 1e-6 square units: in a file in metres those are real edges and real
// square millimetres.
#include "collision/mesh_files/model_file.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_bytes = 64u << 20;
constexpr const char* formats = "give an STL, OBJ, PLY, DAE, glTF or GLB file";
constexpr std::array<const char*, 5> readers = {"Wavefront Object", "Stereolithography", "glTF2",
                                                "Collada", "Stanford Polygon Library (PLY)"};
constexpr std::array<const char*, 6> extensions = {".stl", ".obj", ".ply", ".dae", ".gltf", ".glb"};

[[noreturn]] void refuse(const fs::path& file, const std::string& problem, const std::string& fix) {
  throw InputError({{file.string(), 0, "mesh", problem, fix, "mesh.file"}});
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
  // The bytes of a file that the model names; nothing where there is none that it may read.
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
    if (std::any_of(readers.begin(), readers.end(),
                    [&](const char* one) { return name.starts_with(one); }))
      continue;
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

// The reader of PLY looks for the end of the header for ever.
bool has_whole_ply_header(const fs::path& file) {
  constexpr std::size_t longest = 1u << 16;
  std::string head(longest, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find("\nend_header") != std::string::npos;
}

void check_file(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) refuse(file, "there is no such file", "check the path");
  if (!fs::is_regular_file(file, error)) refuse(file, "this is not a file", formats);
  const std::string extension = lower_extension(file);
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
    refuse(file, "'" + extension + "' is not a mesh format that is read here", formats);
  if (fs::file_size(file, error) > max_bytes)
    refuse(file, "the file has more than 64 MiB", "simplify the mesh");
  if (!std::ifstream(file)) refuse(file, "cannot be opened", "check the permissions of the file");
  if (extension == ".ply" && !has_whole_ply_header(file))
    refuse(file, "its header does not end", "export the mesh again");
}

// IEC 61966-2-1; glTF states colours linearly, the others as they are seen.
float encoded(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

// Takes assimp's scene apart, with its textures read.
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
      add_looks(mesh, *scene_.mMaterials[mesh.mMaterialIndex], part);
    model.parts.push_back(std::move(part));
  }

 private:
  void add_looks(const aiMesh& mesh, const aiMaterial& material, ModelPart& part) {
    aiString name;
    if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS &&
        std::string(name.C_Str()) == AI_DEFAULT_MATERIAL_NAME)
      return;  // the reader's own, where the file has none
    aiColor4D c;
    if (material.Get(AI_MATKEY_COLOR_DIFFUSE, c) == aiReturn_SUCCESS) {
      part.has_color = 1;
      float opacity = c.a;
      material.Get(AI_MATKEY_OPACITY, opacity);
      part.color = {c.r, c.g, c.b, opacity};
      for (std::size_t k = 0; k < 4; ++k) {
        if (linear_ && k < 3) part.color[k] = encoded(part.color[k]);
        part.color[k] = std::isfinite(part.color[k]) ? std::clamp(part.color[k], 0.0f, 1.0f) : 1;
      }
    }
    aiString texture;
    if (mesh.HasTextureCoords(0) &&
        material.GetTexture(aiTextureType_DIFFUSE, 0, &texture) == aiReturn_SUCCESS)
      part.texture = texture_of(texture.C_Str());
  }

  std::int32_t texture_of(const std::string& name) {
    const auto [place, is_new] = texture_.try_emplace(name, -1);
    if (!is_new) return place->second;
    const aiTexture* const inside = scene_.GetEmbeddedTexture(name.c_str());
    std::optional<std::string> bytes;
    if (inside && inside->mHeight == 0)  // a file within the file, mWidth bytes long
      bytes = std::string(reinterpret_cast<const char*>(inside->pcData), inside->mWidth);
    else if (!inside)
      bytes = folder_.read(name);
    if (!bytes) {
      model.notes.push_back("texture '" + name + "' is not to be found in the model's folder");
      return -1;
    }
    model.textures.push_back({name, std::move(*bytes)});
    return place->second = static_cast<std::int32_t>(model.textures.size()) - 1;
  }

  const aiScene& scene_;
  const FolderIO& folder_;
  bool linear_;
  std::map<std::string, std::int32_t> texture_;
};

// What the child does. A message in place of a model begins with '!'.
std::string read_packed(const fs::path& file) {
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
      file.string(), aiProcess_RemoveComponent | aiProcess_Triangulate | aiProcess_SortByPType |
                         aiProcess_PreTransformVertices | aiProcess_ValidateDataStructure);
  if (scene == nullptr) return std::string("!") + importer.GetErrorString();
  const std::string extension = lower_extension(file);
  AssimpConverter taker(*scene, *folder, extension == ".gltf" || extension == ".glb");
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) taker.add(*scene->mMeshes[i]);
  return " " + pack(std::move(taker.model));
}

void check_parts(const fs::path& file, const ModelFile& model) {
  const char* const fix = "export the mesh again";
  for (const ModelPart& part : model.parts) {
    for (const auto& p : part.positions)
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
        refuse(file, "a coordinate is not a finite number", fix);
    const auto count = static_cast<std::int32_t>(part.positions.size());
    for (const auto& t : part.triangles)
      for (const std::int32_t v : t)
        if (v < 0 || v >= count) refuse(file, "a triangle names a vertex that does not exist", fix);
    for (const auto& uv : part.uv)
      if (!std::isfinite(uv[0]) || !std::isfinite(uv[1]))
        refuse(file, "a texture coordinate is not a finite number", fix);
    if (!part.uv.empty() && part.uv.size() != part.positions.size())
      refuse(file, "texture coordinates are not as many as vertices", fix);
    if (part.texture >= static_cast<std::int32_t>(model.textures.size()))
      refuse(file, "a part names a texture that does not exist", fix);
  }
  if (model.parts.empty()) refuse(file, "there is no triangle in it", formats);
}

}  // namespace

ModelFile read_model(const fs::path& file, const ChildLimits& limits) {
  check_file(file);
  const ChildResult result = run_limited([&] { return read_packed(file); }, limits);
  if (!result.fault.empty())
    refuse(file, "the reader of this format " + result.fault + " on it",
           "export the mesh again, best as STL, OBJ or GLB");
  if (result.bytes.starts_with('!'))
    refuse(file, "cannot be read: " + result.bytes.substr(1), "export the mesh again");
  std::optional<ModelFile> model = unpack_model(result.bytes.substr(1));
  if (!model) refuse(file, "the reader of this format fails on it", "export the mesh again");
  check_parts(file, *model);
  return std::move(*model);
}

}  // namespace twinarm
