// What a file of meshes holds: parts with their colours and textures. STL, OBJ, PLY, Collada (DAE),
// glTF and GLB.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "collision/mesh_files/sandboxed_process.h"

namespace twinarm {

// Triangles of one material, in the file's axes and units (Collada: metres, by the unit that the
// file declares; its up axis is left alone, as readers of URDF expect). Parts that the file places
// by nodes stand where those say.
struct ModelPart {
  std::vector<std::array<float, 3>> positions;  // finite
  std::vector<std::array<float, 2>> uv;  // by position, (0, 0) at the picture's top left; or empty
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::int32_t has_color = 0;    // 1 where the file states a colour:
  std::array<float, 4> color{};  // sRGB and opacity, in [0, 1]
  std::int32_t texture = -1;     // index into ModelFile::textures
};
struct ModelTexture {
  std::string name;   // as the file names it
  std::string bytes;  // of the picture's file, PNG or JPEG, not yet decoded
};
struct ModelFile {
  std::vector<ModelPart> parts;  // each with triangles
  std::vector<ModelTexture> textures;
  std::vector<std::string> notes;  // what was left out, for the user to know
};

// Throws InputError (file, rule, remedy) if the file is missing, unreadable, too large (64 MiB), of
// another format, malformed, without triangles, or holds a coordinate that is not finite; or if the
// reader crashes on it or goes beyond its limits. Files that the model names (buffers, materials,
// textures) are opened only inside its own folder.
ModelFile read_model(const std::filesystem::path& file, const ChildLimits& limits = {});

// A ModelFile as bytes, to be sent from the process that read it.
std::string pack(ModelFile model);
// Empty where the bytes are no such model: whoever sent them may have been broken. Indices are not
// looked at.
std::optional<ModelFile> unpack_model(std::string bytes);

}  // namespace twinarm
