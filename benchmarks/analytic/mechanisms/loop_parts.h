// What the loop cases are built from.
#pragma once

#include "solver/dynamics/model_builder.h"

namespace twinarm::loop_parts {

inline Pose at(double x, double y, double z) {
  return {Matrix3::Identity(), {x, y, z}};
}
// A frame whose z is the world's y: of hinges in the x-z plane.
inline Matrix3 z_along_y() {
  return (Matrix3() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished();
}
// A uniform slender rod from its link's origin along a unit vector.
inline BodyInertia rod(double mass, double length, const Vector3& along) {
  return {mass, 0.5 * length * along,
          mass * length * length / 12 * (Matrix3::Identity() - along * along.transpose())};
}

}  // namespace twinarm::loop_parts
