// Two geometries and their contacts.
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
  PairScene(const Shape& a, const Shape& b, double margin) : PairScene(a, b) { usual = margin; }
  const std::vector<Contact>& touch(const Pose& X_WA, const Pose& X_WB) {
    return touch(X_WA, X_WB, usual);
  }
  const std::vector<Contact>& touch(const Pose& X_WA, const Pose& X_WB, double margin) {
    world.detect(std::array{X_WA, X_WB}, margin, contacts);
    return contacts;
  }
  const Contact& deepest() const {
    return *std::max_element(contacts.begin(), contacts.end(),
                             [](const Contact& x, const Contact& y) { return x.depth < y.depth; });
  }
  // Far below 0 without contact.
  double depth() const { return contacts.empty() ? -1e300 : deepest().depth; }
  CollisionWorld world;
  std::vector<Contact> contacts;
  double usual = 1e-3;  // margin
};

}  // namespace twinarm::test
