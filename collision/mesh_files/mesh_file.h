// Triangle meshes from files: STL, OBJ, PLY, DAE, glTF and GLB.
#pragma once

#include <filesystem>

#include "collision/geometry/mesh.h"

namespace twinarm {

// All parts of `file` as one mesh in the axes of the file (glTF: y up), vertices merged,
// coordinates times `scale` (0.001 for millimetres). Throws InputError as read_model()
// (model_file.h), or without a triangle of three different vertices.
TriangleMesh load_mesh(const std::filesystem::path& file, double scale);

}  // namespace twinarm
