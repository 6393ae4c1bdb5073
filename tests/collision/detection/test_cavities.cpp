// Cavities (inside of spheres and tubes): against sampled points, and closed forms.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "collision/detection/collision_world.h"
#include "solver/support/diagnostics.h"
#include "tests/collision/detection/pair_scene.h"
#include "tests/collision/narrow_phase/oracle.h"

using namespace twinarm;
using namespace twinarm::test;

namespace {

// Distance of a point of the body from the wall, negative with penetration.
double beyond(const Shape& hollow, const Vector3& p, double tolerance = 0) {
  if (const auto* sphere = std::get_if<SphericalCavity>(&hollow)) return p.norm() - sphere->radius;
  const auto& tube = std::get<CylindricalCavity>(hollow);
  if (std::abs(p.z()) > tube.length / 2 + tolerance) return -1e300;
  return std::hypot(p.x(), p.y()) - tube.radius;
}

}  // namespace

TEST_CASE("cavity: the depth is that of the farthest of many points of the body") {
  Random random(44);
  const std::vector<Shape> bodies = {Sphere{0.06},        Box{{0.2, 0.14, 0.1}},
                                     Capsule{0.05, 0.2},  Cylinder{0.06, 0.15},
                                     random_hull(random), Ellipsoid{{0.11, 0.05, 0.07}}};
  for (const Shape& hollow : {Shape(SphericalCavity{0.5}), Shape(CylindricalCavity{0.5, 0.7})}) {
    for (const Shape& body : bodies) {
      CAPTURE(shape_name(hollow));
      CAPTURE(shape_name(body));
      PairScene scene(hollow, body);
      double too_shallow = 0, too_deep = 0, off_wall = 0;
      int touched = 0;
      for (int k = 0; k < 100; ++k) {
        const Pose X_WH = random_pose(random);
        Vector3 out = random.direction();
        if (std::holds_alternative<CylindricalCavity>(hollow)) {
          out.z() = 0;
          out.normalize();
          out.z() = random.uniform(-0.4, 0.4);
        }
        const Pose X_HB{random.rotation(), random.uniform(0.4, 0.46) * out};
        double oracle = -1e300;
        for (int i = 0; i < 4000; ++i) {  // points of the surface
          const Vector3 x = X_HB * support(body, random.direction());
          oracle = std::max(oracle, beyond(hollow, x));
        }
        const double margin = 1e-2;
        scene.touch(X_WH, X_WH * X_HB, margin);
        if (scene.contacts.empty()) {
          CHECK(oracle < -margin + 1e-12);
          continue;
        }
        ++touched;
        const Contact& deepest = scene.deepest();
        // Vertices are found from any direction; sampled points of smooth bodies are a few mm
        // apart.
        too_shallow = std::max(too_shallow, oracle - deepest.depth);
        if (oracle > -margin) too_deep = std::max(too_deep, deepest.depth - oracle);
        for (const Contact& c : scene.contacts) {  // on the wall, normal inward
          const Vector3 p = X_WH.inverse() * (c.p_WC + 0.5 * c.depth * c.n_W);
          off_wall = std::max(off_wall, std::abs(beyond(hollow, p, 1e-9)));
        }
      }
      CHECK(touched > 10);
      CHECK(too_shallow < 1e-12);
      CHECK(too_deep < 1e-3);
      CHECK(off_wall < 1e-12);
    }
  }
}

TEST_CASE("sphere in a bowl and in a tube, cylinder in a tube: closed forms of depth and normal") {
  Random random(45);
  PairScene bowl(SphericalCavity{1}, Sphere{0.1}), tube(CylindricalCavity{1, 2}, Sphere{0.1});
  PairScene roller(CylindricalCavity{1, 2}, Cylinder{0.1, 0.3}),
      swapped(Sphere{0.1}, SphericalCavity{1});
  for (int k = 0; k < 500; ++k) {
    const double depth = random.uniform(-9e-4, 1e-3), angle = random.uniform(-3, 3);
    const Vector3 out = random.direction(), across(std::cos(angle), std::sin(angle), 0);
    REQUIRE(bowl.touch(origin, {random.rotation(), (0.9 + depth) * out}).size() == 1);
    CHECK(std::abs(bowl.contacts[0].depth - depth) < 1e-14);
    CHECK((bowl.contacts[0].n_W + out).norm() < 1e-14);
    CHECK((bowl.contacts[0].p_WC - (1 + depth / 2) * out).norm() < 1e-14);
    REQUIRE(swapped.touch({random.rotation(), (0.9 + depth) * out}, origin).size() == 1);
    CHECK((swapped.contacts[0].n_W - out).norm() < 1e-14);
    const Vector3 p = (0.9 + depth) * across + Vector3(0, 0, random.uniform(-0.8, 0.8));
    REQUIRE(tube.touch(origin, {random.rotation(), p}).size() == 1);
    CHECK(std::abs(tube.contacts[0].depth - depth) < 1e-14);
    CHECK((tube.contacts[0].n_W + across).norm() < 1e-14);
    REQUIRE(roller.touch(origin, {turn(random.uniform(-3, 3), Vector3::UnitZ()), p}).size() == 2);
    for (const Contact& c : roller.contacts) {
      CHECK(std::abs(c.depth - depth) < 1e-14);
      CHECK((c.n_W + across).norm() < 1e-12);
    }
  }
}

TEST_CASE("a shaft through a short tube has contacts at its ends") {
  const double depth = 1e-5;
  for (const Shape& shaft :
       {Shape(Capsule{0.02, 1}), Shape(Cylinder{0.02, 1}), Shape(Box{{0.04, 0.04, 1}})}) {
    CAPTURE(shape_name(shaft));
    PairScene scene(CylindricalCavity{0.1, 0.2}, shaft);
    for (int k = 0; k < 50; ++k) {
      const double angle = std::holds_alternative<Box>(shaft) ? 0 : 0.1 * k;
      // Edge of a box, at half its diagonal.
      const double reach = std::holds_alternative<Box>(shaft) ? 0.02 * std::numbers::sqrt2 : 0.02;
      const double turned = std::holds_alternative<Box>(shaft) ? std::numbers::pi / 4 : 0.3 * k;
      const Vector3 across(std::cos(angle), std::sin(angle), 0);
      scene.touch(origin, {turn(turned, Vector3::UnitZ()), (0.1 + depth - reach) * across});
      REQUIRE(scene.contacts.size() == 2);
      for (const Contact& c : scene.contacts) {
        CHECK(std::abs(c.depth - depth) < 1e-14);
        CHECK((c.n_W + across).norm() < 1e-12);
        CHECK(std::abs(std::abs(c.p_WC.z()) - 0.1) < 1e-14);
      }
    }
  }
}

TEST_CASE("a long ellipsoid in a bowl rests on both tips; two cavities are rejected") {
  PairScene scene(SphericalCavity{0.2}, Ellipsoid{{0.19, 0.02, 0.03}});
  const double height = std::sqrt(0.04 - 0.19 * 0.19);
  for (const double shift : {0.0, 1e-14, -1e-9, 1e-5})
    CHECK(scene.touch(origin, {Matrix3::Identity(), {shift, 0, -height}}).size() == 2);
  CollisionWorld world;
  world.add({"bowl", SphericalCavity{1}, 0});
  CHECK_THROWS_AS(world.add({"tube", CylindricalCavity{1, 1}, 0}), InputError);
  CHECK_THROWS_AS(world.add({"floor", HalfSpace{}, 0}), InputError);
  CHECK_THROWS_AS(world.add({"point", Ellipsoid{{0.1, 0, 0.1}}, 0}), InputError);
}
