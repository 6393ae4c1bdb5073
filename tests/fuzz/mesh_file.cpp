// A mesh, in a format that the first byte chooses, through the child process that reads it; and
// what becomes of it then.
#include <array>

#include "collision/geometry/convex_hull.h"
#include "collision/mesh_files/mesh_file.h"
#include "collision/mesh_files/model_file.h"
#include "collision/shapes/mesh_shape.h"
#include "collision/shapes/shape.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {

void mesh_file(Bytes bytes) {
  constexpr std::array<const char*, 6> kKinds{".stl", ".obj", ".ply", ".dae", ".gltf", ".glb"};
  if (bytes.empty()) return;
  const auto kind = static_cast<unsigned char>(bytes[0]) % kKinds.size();
  const std::filesystem::path file =
      folder().write(std::string("mesh") + kKinds[kind], bytes.substr(1));
  goes_through([&] {
    read_model(file, {.cpu_seconds = 2, .bytes = std::size_t{1} << 30});
    const TriangleMesh mesh = load_mesh(file, 1);
    MeshShape{mesh}.fault();
    goes_through([&] { mass_properties(mesh, 1000); });
    goes_through([&] { convex_hull(mesh.vertices); });
  });
}

}  // namespace twinarm::fuzz
