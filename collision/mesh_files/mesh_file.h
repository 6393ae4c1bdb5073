// Triangle meshes from files: STL, OBJ, PLY, DAE, glTF and GLB.
#pragma once

#include <filesystem>

#include "collision/geometry/mesh.h"

namespace twinarm {

// The mesh in `file` with all its parts in one list, vertices welded, coordinates times `scale`
// (0.001 for a file in millimetres). The axes are those of the file; so a glTF file is y-up.
// Throws InputError where read_model() (model_file.h) does, or where nothing has three corners.
TriangleMesh load_mesh(const std::filesystem::path& file, double scale);

}  // namespace twinarm
