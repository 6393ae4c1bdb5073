#include "benchmarks/scenes/scene_model.h"

#include "benchmarks/scenes/eigen.h"
#include "solver/dynamics/model_builder.h"

namespace twinarm::bench {

Model<double> model_of(const Scene& scene) {
  ModelBuilder builder;
  builder.set_gravity(vector3(scene.gravity));
  int number = 0;
  for (const Body& b : scene.bodies) {
    const JointType type = b.joint == Joint::revolute    ? JointType::revolute
                           : b.joint == Joint::spherical ? JointType::spherical
                                                         : JointType::free;
    const std::string name = std::to_string(++number);
    builder.add_body(name, b.parent + 1, "joint " + name, type,
                     {matrix3(b.rotation), vector3(b.position)}, axis_of(b),
                     {b.mass, vector3(b.com), inertia3(b.inertia)});
  }
  return builder.build();
}

}  // namespace twinarm::bench
