#include "app/scene/model/scene_shapes.h"

#include <type_traits>

#include "collision/geometry/convex_hull.h"
#include "collision/import/robot/mesh_geometry.h"

namespace twinarm {
MassProperties solid_properties(const ShapeDescription& shape, double density) {
  return mass_properties(collision_shape(shape), density);
}

Shape collision_shape(const ShapeDescription& shape) {
  return std::visit(
      [](const auto& known) -> Shape {
        if constexpr (!std::is_same_v<decltype(known), const MeshGeometry&>) {
          return known;
        } else {
          TriangleMesh mesh = load_mesh(known);
          if (known.convex) return convex_hull(mesh.vertices);
          return MeshShape{std::move(mesh)};
        }
      },
      shape);
}

}  // namespace twinarm
