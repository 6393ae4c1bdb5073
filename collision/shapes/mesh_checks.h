// What is wrong with a triangle mesh that is to be collided with.
#pragma once

#include <string>

#include "collision/shapes/shape.h"

namespace twinarm {

// All that is wrong with a mesh: empty, indices, not finite, degenerate triangles, the same ones
// twice, open or flipped surface, millimetres. Empty text if nothing.
std::string mesh_fault(const MeshShape& shape);

}  // namespace twinarm
