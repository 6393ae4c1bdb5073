// The triangles of a MeshGeometry.
#pragma once

#include "collision/import/robot_description.h"
#include "collision/mesh.h"

namespace twinarm {

// In metres. A mirrored mesh (an odd number of negative scales) has its triangles turned about, so
// that they are still counter-clockwise seen from outside. Throws InputError where the file is
// missing or no mesh.
TriangleMesh load_mesh(const MeshGeometry& geometry);

}  // namespace twinarm
