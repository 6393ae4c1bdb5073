#include "app/scene/model/scene_shapes.h"

#include "collision/import/robot/mesh_geometry.h"
#include "collision/shapes/convex_hull.h"

namespace twinarm {
namespace {

struct ToCollision {
  Shape operator()(const BoxGeometry& box) const { return Box{box.size}; }
  Shape operator()(const SphereGeometry& sphere) const { return Sphere{sphere.radius}; }
  Shape operator()(const CapsuleGeometry& c) const { return Capsule{c.radius, c.length}; }
  Shape operator()(const CylinderGeometry& c) const { return Cylinder{c.radius, c.length}; }
  Shape operator()(const HalfSpaceSpec& half) const { return HalfSpace{half.normal, half.offset}; }
  Shape operator()(const EllipsoidSpec& e) const { return Ellipsoid{e.semi_axes}; }
  Shape operator()(const HollowSphereSpec& hollow) const { return HollowSphere{hollow.radius}; }
  Shape operator()(const HollowCylinderSpec& c) const { return HollowCylinder{c.radius, c.length}; }
  Shape operator()(const MeshSpec& spec) const {
    TriangleMesh mesh = load_mesh(spec.mesh);
    if (spec.convex) return convex_hull(mesh.vertices);
    return MeshShape{std::move(mesh)};
  }
};

}  // namespace

MassProperties solid_properties(const ShapeSpec& shape, double density) {
  return mass_properties(collision_shape(shape), density);
}

Shape collision_shape(const ShapeSpec& shape) {
  return std::visit(ToCollision{}, shape);
}

}  // namespace twinarm
