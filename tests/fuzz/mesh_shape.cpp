// Triangles of any kind as a shape to collide with: looked at, weighed, wrapped in a hull, touched.
// The bytes: how coordinates are coded, their number, coordinates, corners.
#include <cmath>
#include <cstring>

#include "collision/mesh_files/mesh_file.h"
#include "collision/narrow_phase/narrow_phase.h"
#include "collision/shapes/mesh_shape.h"
#include "collision/shapes/shape.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {
namespace {

TriangleMesh mesh_of(Bytes bytes) {
  TriangleMesh mesh;
  if (bytes.size() < 2) return mesh;
  const bool is_float = (bytes[0] & 1) != 0;
  const auto wanted = static_cast<unsigned char>(bytes[1]);
  bytes.remove_prefix(2);
  const std::size_t size = is_float ? sizeof(float) : 1;
  while (mesh.vertices.size() < wanted && bytes.size() >= 3 * size) {
    Vector3 p;
    for (Eigen::Index c = 0; c < 3; ++c) {
      float x = static_cast<float>(static_cast<signed char>(bytes[0])) / 16;
      if (is_float) std::memcpy(&x, bytes.data(), sizeof x);
      p[c] = std::isfinite(x) ? x : 0;  // as the reader of files has it
      bytes.remove_prefix(size);
    }
    mesh.vertices.push_back(p);
  }
  for (; !mesh.vertices.empty() && bytes.size() >= 3; bytes.remove_prefix(3)) {
    std::array<int, 3> t;
    for (std::size_t k = 0; k < 3; ++k)
      t[k] = static_cast<int>(static_cast<unsigned char>(bytes[k]) % mesh.vertices.size());
    mesh.triangles.push_back(t);
  }
  return mesh;
}

}  // namespace

void mesh_shape(Bytes bytes) {
  const TriangleMesh mesh = mesh_of(bytes);
  is_closed(mesh);
  goes_through([&] { mass_properties(mesh, 1000); });
  goes_through([&] {
    const ConvexHull hull = convex_hull(mesh.vertices);
    for (const Vector3& n : hull.normals) require(n.allFinite(), "a hull has a bad normal");
    goes_through([&] { mass_properties(Shape(hull), 1000); });
    const PreparedShape solid((Shape(hull)));
  });
  if (MeshShape{mesh}.fault().empty()) const PreparedShape solid((Shape(MeshShape{mesh})));
}

}  // namespace twinarm::fuzz
