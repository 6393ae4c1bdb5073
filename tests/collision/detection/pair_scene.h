// Two geometries and what detection says of them.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <vector>

#include "collision/detection/collision_world.h"

namespace twinarm::test {

inline const Pose origin;

inline Matrix3 turn(double angle, const Vector3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

struct PairScene {
  PairScene(const Shape& a, const Shape& b) {
    world.add({"a", a, 0});
    world.add({"b", b, 0});
  }
  const std::vector<Contact>& touch(const Pose& X_WA, const Pose& X_WB, double margin = 1e-3) {
    world.detect(std::array{X_WA, X_WB}, margin, contacts);
    return contacts;
  }
  const Contact& deepest() const {
    return *std::max_element(contacts.begin(), contacts.end(),
                             [](const Contact& x, const Contact& y) { return x.depth < y.depth; });
  }
  CollisionWorld world;
  std::vector<Contact> contacts;
};

}  // namespace twinarm::test
