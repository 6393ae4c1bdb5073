// Meshes as GET /mesh/HASH sends them, and what they are called.
#pragma once

#include <string>

#include "app/render/list/draw_mesh.h"

namespace twinarm {

// u32 vertices, indices, flags (1: two-sided, 2: has uv), 0; then positions, normals, uv, indices.
std::string mesh_bytes(const DrawMesh& mesh);
// 128 bits in hexadecimal: of equal content equal, else different.
std::string content_name(const std::string& bytes);

}  // namespace twinarm
