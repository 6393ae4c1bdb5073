// The triangles of a MeshGeometry.
#pragma once

#include "collision/geometry/mesh.h"
#include "collision/import/robot/robot_description.h"

namespace twinarm {

// Where its file lies. Throws InputError where it was not found.
const std::filesystem::path& file_of(const MeshGeometry& geometry);
// In metres. A mirrored mesh (an odd number of negative scales) has its triangles turned about, so
// that they are still counter-clockwise seen from outside. Throws InputError where the file is
// missing or no mesh.
TriangleMesh load_mesh(const MeshGeometry& geometry);

}  // namespace twinarm
