// Binary STL.
#include "collision/import/recipe/stl_writer.h"

#include <Eigen/Geometry>
#include <bit>
#include <cstdint>
#include <cstring>

namespace twinarm {

static_assert(std::endian::native == std::endian::little, "STL files are little-endian");

std::string stl_bytes(const TriangleMesh& mesh, double scale) {
  std::string bytes = "binary STL, written by twinarm";  // must not start with "solid"
  bytes.resize(80, ' ');
  const auto append = [&bytes](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  append(&count, 4);
  for (const auto& triangle : mesh.triangles) {
    Eigen::Vector3f corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = (mesh.vertices[triangle[k]] / scale).cast<float>();
    const Eigen::Vector3f normal =
        (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    append(normal.data(), 12);
    for (const Eigen::Vector3f& c : corner) append(c.data(), 12);
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace twinarm
