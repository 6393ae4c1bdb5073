// Ellipsoids, discs and cylinders: known contact points; fast spheres.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "collision/detection/collision_world.h"
#include "tests/collision/detection/pair_scene.h"
#include "tests/collision/narrow_phase/oracle.h"

using namespace twinarm;
using namespace twinarm::test;

TEST_CASE("an ellipsoid touches a half-space at x = -Q n / sqrt(n' Q n)") {
  Random random(41);
  const Ellipsoid e{{0.2, 0.03, 0.02}};
  PairScene scene(HalfSpace{}, e);
  double worst = 0;
  for (int k = 0; k < 2000; ++k) {
    const Matrix3 R = random.rotation();
    const Matrix3 Q = R * e.semi_axes.cwiseAbs2().asDiagonal() * R.transpose();
    const double height = std::sqrt(Q(2, 2)), depth = random.uniform(-9e-4, 5e-3);
    const Vector3 lowest = -Q.col(2) / height;
    scene.touch(origin, {R, {0.3, -0.2, height - depth}});
    REQUIRE(scene.contacts.size() == 1);
    const Vector3 p(0.3 + lowest.x(), -0.2 + lowest.y(), -depth / 2);
    worst = std::max(
        {worst, std::abs(scene.contacts[0].depth - depth), (scene.contacts[0].p_WC - p).norm()});
  }
  CHECK(worst < 1e-15);
}

TEST_CASE("ellipsoids with equal semi-axes equal spheres, against every shape") {
  Random random(42);
  const std::vector<Shape> others = {Sphere{0.06},        Box{{0.2, 0.14, 0.1}},
                                     Capsule{0.05, 0.2},  Cylinder{0.06, 0.15},
                                     random_hull(random), Ellipsoid{{0.1, 0.06, 0.04}}};
  for (const Shape& other : others) {
    CAPTURE(shape_name(other));
    PairScene round(other, Sphere{0.07}), ellipsoid(other, Ellipsoid{Vector3::Constant(0.07)});
    double depth = 0, place = 0, normal = 0;
    for (int k = 0; k < 500; ++k) {
      const Pose X_WA = random_pose(random);
      const Pose X_WB =
          pushed_against(random, other, X_WA, Sphere{0.07}, random.uniform(-0.01, 1e-3));
      if (round.touch(X_WA, X_WB).empty()) continue;
      REQUIRE(ellipsoid.touch(X_WA, X_WB).size() == 1);
      const Contact &x = round.contacts[0], &y = ellipsoid.contacts[0];
      depth = std::max(depth, std::abs(x.depth - y.depth));
      place = std::max(place, (x.p_WC - y.p_WC).norm());
      normal = std::max(normal, (x.n_W - y.n_W).norm());
    }
    CHECK(depth < 1e-12);
    CHECK(place < 1e-7);
    CHECK(normal < 1e-7);
  }
}

TEST_CASE("an ellipsoid's contact point is smooth: second differences of order 2") {
  Random random(43);
  const Ellipsoid e{{0.11, 0.05, 0.03}};
  for (const Shape& table : {Shape(Box{{1, 1, 0.2}}), Shape(Ellipsoid{{0.5, 0.6, 0.1}}),
                             Shape(Cylinder{0.7, 0.2}), Shape(HalfSpace{Vector3::UnitZ(), 0.1})}) {
    CAPTURE(shape_name(table));
    PairScene scene(table, e);
    double roughest = 0;
    for (int k = 0; k < 100; ++k) {
      const Vector3 axis = random.direction();
      const Matrix3 R = random.rotation();
      std::array<Vector3, 3> p;
      const double step = 1e-4;
      for (int i = 0; i < 3; ++i) {
        const Matrix3 Ri = turn(step * i, axis) * R;
        const double height = (Ri * e.semi_axes.asDiagonal()).row(2).norm();
        scene.touch(origin, {Ri, {0.01, 0.02, 0.1 + height - 1e-4}}, 1e-2);
        REQUIRE(scene.contacts.size() == 1);
        p[static_cast<std::size_t>(i)] = scene.contacts[0].p_WC;
      }
      roughest = std::max(roughest, (p[0] - 2 * p[1] + p[2]).norm() / (step * step));
    }
    CHECK(roughest < 20);  // [m]: a few times the maximum radius of curvature, 0.4 m
  }
}

TEST_CASE("a rolling coin on its rim touches at the lowest point of the rim") {
  const double radius = 0.0375, tilt = 10 * std::numbers::pi / 180;
  for (const double thickness : {1e-3, 1e-5}) {
    for (const double angle : {tilt, 0.12, 0.01, 1e-4}) {
      for (const Shape& table :
           {Shape(HalfSpace{Vector3::UnitZ(), 0.1}), Shape(Box{{1, 1, 0.2}})}) {
        CAPTURE(shape_name(table));
        CAPTURE(angle);
        CAPTURE(thickness);
        PairScene scene(table, Cylinder{radius, thickness});
        double worst = 0;
        int name = 0, renamed = 0;
        for (int k = 0; k < 400; ++k) {
          const double heading = 2 * std::numbers::pi * k / 400, spin = 0.37 * k;
          const Matrix3 R = turn(heading, Vector3::UnitZ()) * turn(angle, Vector3::UnitY()) *
                            turn(spin, Vector3::UnitZ());
          // Lowest point, of the lower cap: along +x of the heading, and down.
          const Matrix3 T = turn(heading, Vector3::UnitZ()) * turn(angle, Vector3::UnitY());
          const Vector3 r = T * Vector3(radius, 0, -thickness / 2);
          const double depth = 1e-6;
          const Pose X{R, {0.01, 0.02, 0.1 - depth - r.z()}};
          scene.touch(origin, X, 1e-5);
          REQUIRE(!scene.contacts.empty());
          const Contact& lowest = scene.deepest();
          const Vector3 p = X.p + r;
          worst =
              std::max({worst, std::abs(lowest.depth - depth), (lowest.p_WC - p).head<2>().norm(),
                        (lowest.n_W - Vector3::UnitZ()).norm()});
          if (k > 0 && lowest.feature != name) ++renamed;
          name = lowest.feature;
          // One point, unless the opposite side of the rim is within the margin.
          if (2 * radius * std::sin(angle) * 0.14 > 1.2e-5 && thickness > 1e-4)
            CHECK(scene.contacts.size() == 1);
        }
        CHECK(worst < 2e-12 * (1e-2 / angle));  // rounding of the tilt's direction
        CHECK(renamed == 0);
      }
    }
  }
}

TEST_CASE("a flat coin has four contact points on its rim that rotate with it") {
  for (const Shape& table : {Shape(HalfSpace{Vector3::UnitZ(), 0.1}), Shape(Box{{1, 1, 0.2}})}) {
    PairScene scene(table, Cylinder{0.0375, 1e-3});
    std::vector<Contact> before;
    for (int k = 0; k < 100; ++k) {
      const Matrix3 R =
          turn(1e-9, Vector3(k % 7 - 3, k % 5 - 2, 0.1)) * turn(1e-3 * k, Vector3::UnitZ());
      scene.touch(origin, {R, {0.01, 0.02, 0.1 + 0.5e-3 - 1e-7}}, 1e-4);
      REQUIRE(scene.contacts.size() == 4);
      for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(scene.contacts[i].feature == before[i].feature);
        CHECK((scene.contacts[i].p_WC - before[i].p_WC).norm() < 1e-4);
      }
      before = scene.contacts;
    }
  }
}

TEST_CASE("lying cylinders and capsules roll on two points at the ends of their lines") {
  const double radius = 0.05, length = 0.2;
  for (const Shape& table : {Shape(HalfSpace{Vector3::UnitZ(), 0.1}), Shape(Box{{1, 1, 0.2}})}) {
    for (const Shape& roll : {Shape(Cylinder{radius, length}), Shape(Capsule{radius, length})}) {
      CAPTURE(shape_name(roll));
      PairScene scene(table, roll);
      std::vector<int> names;
      for (int k = 0; k < 200; ++k) {
        const double heading = 0.4 + 1e-3 * k;
        const Matrix3 R = turn(heading, Vector3::UnitZ()) *
                          turn(std::numbers::pi / 2, Vector3::UnitY()) *
                          turn(0.05 * k, Vector3::UnitZ());
        const double depth = k % 2 == 0 ? 1e-7 : -1e-7;
        scene.touch(origin, {R, {0.01, 0, 0.1 + radius - depth}}, 1e-4);
        REQUIRE(scene.contacts.size() == 2);
        const Vector3 along(std::cos(heading), std::sin(heading), 0);
        for (const Contact& c : scene.contacts) {
          CHECK(std::abs(c.depth - depth) < 1e-12);
          const double s = (c.p_WC - Vector3(0.01, 0, 0.1)).dot(along);
          CHECK(std::abs(std::abs(s) - length / 2) < 1e-12);
        }
        if (k > 0)
          CHECK(names == std::vector{scene.contacts[0].feature, scene.contacts[1].feature});
        names = {scene.contacts[0].feature, scene.contacts[1].feature};
      }
    }
  }
}

TEST_CASE("a fast sphere has a contact with a thin plate on its own side before it arrives") {
  CollisionWorld world;
  world.add({"plate", Box{{1, 1, 0.005}}, 0, true});
  world.add({"ball", Sphere{0.005}, 0});
  world.add({"far", Sphere{0.005}, 0});
  const std::array margins{0.0, 50 * 1e-3, 1e-4};  // displacement in 1 ms at 50 m/s
  for (const double side : {1.0, -1.0}) {
    const double gap = 0.04;
    const std::array<Pose, 3> X{origin, Pose{Matrix3::Identity(), {0.1, 0, side * (gap + 0.0075)}},
                                Pose{Matrix3::Identity(), {-0.1, 0, side * (gap + 0.0075)}}};
    std::vector<Contact> contacts;
    world.detect(X, margins, contacts);
    REQUIRE(contacts.size() == 1);  // none for the slow one
    CHECK(contacts[0].b == 1);
    CHECK((contacts[0].n_W - side * Vector3::UnitZ()).norm() < 1e-14);
    CHECK(std::abs(contacts[0].depth + gap) < 1e-14);
  }
}
