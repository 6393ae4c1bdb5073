// Models by a reader in a child process with limits (sandboxed_process.h). Its result is checked:
// finite, indices in range, not empty.
#include "collision/mesh_files/model_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <system_error>
#include <utility>

#include "collision/mesh_files/assimp_reader.h"
#include "solver/support/diagnostics.h"
#include "solver/support/text.h"

namespace twinarm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormats = "give an STL, OBJ, PLY, DAE, glTF or GLB file";
constexpr std::array<const char*, 6> kExtensions = {".stl", ".obj",  ".ply",
                                                    ".dae", ".gltf", ".glb"};

[[noreturn]] void refuse(const fs::path& file, const std::string& problem, const std::string& fix) {
  throw InputError({{file.string(), 0, "mesh", problem, fix, "mesh.file"}});
}

// assimp's PLY reader does not terminate without an end of the header.
bool has_whole_ply_header(const fs::path& file) {
  constexpr std::size_t kMaxHeader = 1u << 16;
  std::string head(kMaxHeader, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find("\nend_header") != std::string::npos;
}

void check_file(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) refuse(file, "the file does not exist", "check the path");
  if (!fs::is_regular_file(file, error)) refuse(file, "this is not a regular file", kFormats);
  const std::string extension = lower_case(file.extension().string());
  if (std::find(kExtensions.begin(), kExtensions.end(), extension) == kExtensions.end())
    refuse(file, "'" + extension + "' is not a supported mesh format", kFormats);
  if (fs::file_size(file, error) > kMaxModelBytes)
    refuse(file, "the file is larger than 64 MiB", "simplify the mesh");
  if (!std::ifstream(file))
    refuse(file, "the file cannot be opened", "check the permissions of the file");
  if (extension == ".ply" && !has_whole_ply_header(file))
    refuse(file, "the PLY header has no end_header line", "export the mesh again");
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
        if (v < 0 || v >= count) refuse(file, "a vertex index is out of range", fix);
    for (const auto& uv : part.uv)
      if (!std::isfinite(uv[0]) || !std::isfinite(uv[1]))
        refuse(file, "a texture coordinate is not a finite number", fix);
    if (!part.uv.empty() && part.uv.size() != part.positions.size())
      refuse(file, "the numbers of texture coordinates and vertices differ", fix);
    if (part.texture >= static_cast<std::int32_t>(model.textures.size()))
      refuse(file, "a texture index is out of range", fix);
  }
  if (model.parts.empty()) refuse(file, "the file has no triangle", kFormats);
}

}  // namespace

ModelFile read_model(const fs::path& file, const ChildLimits& limits) {
  check_file(file);
  const ChildResult result = run_limited(twinarm_assimp_reader(), file.string(), limits);
  if (!result.fault.empty())
    refuse(file, "the reader of this format " + result.fault,
           "export the mesh again, preferably as STL, OBJ or GLB");
  if (result.bytes.starts_with('!'))
    refuse(file, "the file cannot be read: " + result.bytes.substr(1), "export the mesh again");
  auto model = unpacked<ModelFile>(result.bytes.substr(1));
  if (!model) refuse(file, "the reader of this format fails", "export the mesh again");
  check_parts(file, *model);
  return std::move(*model);
}

}  // namespace twinarm
