// Binary STL: 80 bytes of header, the number of triangles, and 50 bytes a triangle.
#pragma once

#include <string>

#include "collision/geometry/mesh.h"

namespace twinarm {

// The bytes of the file. Its unit is `scale` metres; coordinates are single precision, as the
// format has it. The same mesh gives the same bytes.
std::string stl_bytes(const TriangleMesh& mesh, double scale);

}  // namespace twinarm
