#include "collision/import/robot/mesh_geometry.h"

#include <utility>

#include "collision/mesh_files/mesh_file.h"

namespace twinarm {

const std::filesystem::path& file_of(const MeshGeometry& geometry) {
  if (geometry.file.empty())
    throw InputError({{"", 0, "mesh '" + geometry.name + "'", "its file was not found",
                       "put it where the robot's file names it"}});
  return geometry.file;
}

TriangleMesh load_mesh(const MeshGeometry& geometry) {
  TriangleMesh mesh = load_mesh(file_of(geometry), 1.0);
  for (Vector3& vertex : mesh.vertices) vertex = geometry.scale.cwiseProduct(vertex);
  if (geometry.scale.prod() < 0)
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

}  // namespace twinarm
