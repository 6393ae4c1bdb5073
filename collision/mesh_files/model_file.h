// Contents of mesh files with colours and textures: STL, OBJ, PLY, Collada (DAE), glTF and GLB.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "collision/sandbox/sandboxed_process.h"
#include "solver/support/state_archive.h"

namespace twinarm {

// Triangles of one material, in the file's axes and units (Collada: converted to metres, its up
// axis ignored as URDF readers do). Transformations of nodes are applied.
struct ModelPart {
  std::vector<std::array<float, 3>> positions;  // finite
  std::vector<std::array<float, 2>> uv;  // by position, (0, 0) at the image's top left; or empty
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::int32_t has_color = 0;    // 1: the file has a colour
  std::array<float, 4> color{};  // sRGB and opacity, in [0, 1]
  std::int32_t texture = -1;     // index into ModelFile::textures
};
struct ModelTexture {
  std::string name;   // as in the file
  std::string bytes;  // of the image file, PNG or JPEG
};
struct ModelFile {
  std::vector<ModelPart> parts;  // each with triangles
  std::vector<ModelTexture> textures;
  std::vector<std::string> notes;  // warnings: what was left out
};

// Throws InputError if the file is missing, unreadable, larger than 64 MiB, of another format,
// malformed, without triangles, or has a coordinate that is not finite; or if the reader crashes or
// exceeds its limits. Files that the model refers to (buffers, materials, textures) are opened only
// inside its own folder.
ModelFile read_model(const std::filesystem::path& file, const ChildLimits& limits = {});

// For the transfer between processes (packed(), unpacked()). Does not check indices.
void serialize(StateArchive& archive, ModelFile& model);

}  // namespace twinarm
