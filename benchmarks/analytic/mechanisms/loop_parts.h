// Parts of the mechanisms with closed loops.
#pragma once

#include "solver/dynamics/model_builder.h"
#include "solver/loops/loop_closure.h"

namespace twinarm::loop_parts {

inline Pose at(double x, double y, double z) {
  return {Matrix3::Identity(), {x, y, z}};
}
// Frame with z along the world's y: of hinges in the x-z plane.
inline Matrix3 z_along_y() {
  return (Matrix3() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
}
// A uniform slender rod from its link's origin along a unit vector.
inline BodyInertia rod(double mass, double length, const Vector3& along) {
  return {mass, 0.5 * length * along,
          mass * length * length / 12 * (Matrix3::Identity() - along * along.transpose())};
}

// A uniform rod on a hinge about -y, along x at angle 0: angles rotate x to z.
inline int add_rod(ModelBuilder& builder, const char* name, int parent, const char* joint, double x,
                   double mass, double length) {
  return builder.add_body(name, parent, joint, JointType::revolute, at(x, 0, 0), -Vector3::UnitY(),
                          rod(mass, length, Vector3::UnitX()));
}
// A hinge about y between two bodies, at these points of theirs.
inline LoopClosure hinge_closure(const std::string& name, int a, int b, const Vector3& p_A,
                                 const Vector3& p_B) {
  return {name, LoopType::hinge, a, b, {z_along_y(), p_A}, {z_along_y(), p_B}};
}

}  // namespace twinarm::loop_parts
