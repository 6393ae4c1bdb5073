// Detection does not allocate when warm.
#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "collision/detection/collision_world.h"
#include "collision/narrow_phase/narrow_phase.h"
#include "tests/collision/narrow_phase/oracle.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::test;

namespace {

// One shape of each type, and a second hull.
std::vector<Shape> every_kind() {
  Random random(7);
  return {Sphere{0.06},
          Box{{0.2, 0.14, 0.1}},
          Capsule{0.05, 0.2},
          Cylinder{0.06, 0.15},
          HalfSpace{},
          random_hull(random),
          Ellipsoid{{0.11, 0.05, 0.07}},
          SphericalCavity{0.3},
          CylindricalCavity{0.3, 1},
          MeshShape{box_mesh({0.2, 0.3, 0.1})},
          random_hull(random)};
}

}  // namespace

TEST_CASE("detection and distance of all pairs of shapes do not allocate in the second pass") {
  const std::vector<Shape> shapes = every_kind();
  int pairs = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t j = 0; j < shapes.size(); ++j) {
      if (!is_supported(shapes[i], shapes[j])) continue;
      CAPTURE(shape_name(shapes[i]));
      CAPTURE(shape_name(shapes[j]));
      ++pairs;
      Random random(43);
      CollisionWorld world;
      world.add({"a", shapes[i], 0});
      world.add({"b", shapes[j], 0});
      std::vector<std::array<Pose, 2>> poses;
      for (int k = 0; k < 60; ++k) {
        const Pose X_WA = random_pose(random);
        Pose X_WB = random_pose(random);
        const double distance = random.uniform(0, 0.35);  // a sphere also leaves the cavity
        X_WB.p = X_WA.p + distance * random.direction();
        poses.push_back({X_WA, X_WB});
      }
      std::vector<Contact> contacts;
      double sum = 0;
      std::size_t found = 0;
      const auto pass = [&] {
        for (const std::array<Pose, 2>& x : poses) {
          world.detect(x, 0.01, contacts);
          found += contacts.size();
          sum += world.distance(0, 1, x[0], x[1]);
        }
      };
      pass();
      CHECK(testing::allocations_in(pass) == 0);
      CHECK(found > 0);
      CHECK(std::isfinite(sum));
    }
  }
  CHECK(pairs > 80);
}

TEST_CASE("detection of many moving bodies does not allocate when warm") {
  Random random(47);
  CollisionWorld world;
  std::vector<Pose> start, now;
  std::vector<Vector3> velocity;
  for (int copy = 0; copy < 4; ++copy) {
    for (const Shape& shape : every_kind()) {
      if (!is_supported(shape, HalfSpace{})) continue;
      world.add({"body", shape, 0});
      start.push_back(random_pose(random));
      start.back().p *= 0.4;
      velocity.push_back(random.direction());
    }
  }
  now = start;
  std::vector<Contact> contacts;
  std::size_t found = 0;
  const auto pass = [&] {
    for (int n = 0; n < 200; ++n) {
      for (std::size_t i = 0; i < now.size(); ++i)
        now[i].p = start[i].p + 0.2 * std::sin(0.0314 * n) * velocity[i];
      world.detect(now, 1e-3, contacts);
      found += contacts.size();
    }
  };
  pass(), pass();
  CHECK(testing::allocations_in(pass) == 0);
  CHECK(found > 1000);
}
