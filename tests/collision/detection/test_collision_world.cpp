// Known manifolds, order, filters, errors, and two bodies on a floor.
#include "collision/detection/collision_world.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include "solver/support/diagnostics.h"
#include "tests/collision/detection/pair_scene.h"
#include "tests/collision/narrow_phase/oracle.h"

using namespace twinarm;
using namespace twinarm::test;

namespace {

std::vector<Contact> touch(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB,
                           double margin = 1e-3) {
  return PairScene(a, b).touch(X_WA, X_WB, margin);
}

std::vector<Shape> things_to_put_down() {
  Random random(8);
  return {Sphere{0.06}, Box{{0.2, 0.14, 0.1}}, Capsule{0.05, 0.2}, Cylinder{0.06, 0.15},
          random_hull(random)};
}

}  // namespace

TEST_CASE(
    "a box flat on a larger box or hull has 4 contact points at its vertices, at the right depth") {
  const Vector3 size(0.2, 0.14, 0.1), table_size(1, 1, 0.2);
  const std::vector<Vector3> corners = box_mesh(table_size).vertices;
  Random random(9);
  for (const Shape& table : {Shape(Box{table_size}), Shape(convex_hull(corners))}) {
    for (int k = 0; k < 2000; ++k) {
      const double depth = random.uniform(-5e-4, 2e-3);
      const double yaw = k % 5 == 0 ? 0 : random.uniform(-3, 3);
      const Pose X{turn(yaw, Vector3::UnitZ()),
                   {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0.15 - depth}};
      const auto contacts = touch(table, origin, Box{size}, X);
      REQUIRE(contacts.size() == 4);
      std::set<int> names;
      for (const Contact& c : contacts) {
        CHECK(std::abs(c.depth - depth) < 1e-9);
        CHECK((c.n_W - Vector3::UnitZ()).norm() < 1e-9);
        const Vector3 p = X.inverse() * c.p_WC;  // in the box: at a vertex of its lower face
        CHECK(std::abs(std::abs(p.x()) - 0.1) < 1e-9);
        CHECK(std::abs(std::abs(p.y()) - 0.07) < 1e-9);
        CHECK(std::abs(p.z() - (-0.05 + depth / 2)) < 1e-9);
        names.insert(c.feature);
      }
      CHECK(names.size() == 4);
    }
  }
}

TEST_CASE("box on box: a tilt of 1e-6 neither loses vertices nor rotates the normal") {
  Random random(10);
  for (int k = 0; k < 2000; ++k) {
    const Matrix3 tilt = turn(1e-6, Vector3(random.uniform(-1, 1), random.uniform(-1, 1), 0));
    const Pose X{tilt * turn(random.uniform(-3, 3), Vector3::UnitZ()), {0.1, 0.2, 0.15 - 1e-5}};
    const auto contacts = touch(Box{{1, 1, 0.2}}, origin, Box{{0.2, 0.14, 0.1}}, X);
    REQUIRE(contacts.size() == 4);
    for (const Contact& c : contacts) {
      CHECK(std::abs(c.depth - 1e-5) < 2e-7);
      CHECK((c.n_W - Vector3::UnitZ()).norm() < 2e-6);
    }
  }
}

TEST_CASE("crossing edges of two boxes have one contact point, at the crossing") {
  // A's upper edge along x and B's lower edge along y, both boxes on an edge.
  const double half_diagonal = 0.1 * std::sqrt(2), depth = 1e-3;
  const Pose X_WA{turn(M_PI / 4, Vector3::UnitX()), Vector3::Zero()};
  const Pose X_WB{turn(M_PI / 4, Vector3::UnitY()), {0.02, 0.03, 2 * half_diagonal - depth}};
  auto contacts = touch(Box{{0.2, 0.2, 0.2}}, X_WA, Box{{0.2, 0.2, 0.2}}, X_WB, 1e-4);
  REQUIRE(contacts.size() == 1);
  CHECK(std::abs(contacts[0].depth - depth) < 1e-12);
  CHECK((contacts[0].n_W - Vector3::UnitZ()).norm() < 1e-12);
  CHECK((contacts[0].p_WC - Vector3(0.02, 0, half_diagonal - depth / 2)).norm() < 1e-9);
}

TEST_CASE("lying and upright cylinders and capsules have the expected contact points") {
  const Box table{{1, 1, 0.2}};
  const Matrix3 lying = turn(M_PI / 2, Vector3::UnitX());
  struct Case {
    Shape shape;
    Matrix3 R;
    double height;
    std::size_t count;
  };
  for (const Case& c :
       {Case{Cylinder{0.05, 0.2}, Matrix3::Identity(), 0.1, 4},
        Case{Cylinder{0.05, 0.2}, lying, 0.05, 2}, Case{Capsule{0.05, 0.2}, lying, 0.05, 2},
        Case{Capsule{0.05, 0.2}, Matrix3::Identity(), 0.15, 1},
        Case{Sphere{0.05}, Matrix3::Identity(), 0.05, 1}}) {
    for (const double depth : {-5e-4, 0.0, 1e-5, 1e-3}) {
      CAPTURE(shape_name(c.shape));
      CAPTURE(depth);
      const Pose X{turn(0.3, Vector3::UnitZ()) * c.R, {0.1, 0.05, 0.1 + c.height - depth}};
      const auto contacts = touch(table, origin, c.shape, X);
      REQUIRE(contacts.size() == c.count);
      const auto swapped = touch(c.shape, X, table, origin);
      REQUIRE(swapped.size() == c.count);
      for (const Contact& contact : swapped) {
        CHECK(std::abs(contact.depth - depth) < 1e-8);
        CHECK((contact.n_W + Vector3::UnitZ()).norm() < 1e-8);
        CHECK(std::abs(contact.p_WC.z() - (0.1 - depth / 2)) < 1e-8);
      }
      for (const Contact& contact : contacts) {
        CHECK(std::abs(contact.depth - depth) < 1e-8);
        CHECK((contact.n_W - Vector3::UnitZ()).norm() < 1e-8);
        CHECK(std::abs(contact.p_WC.z() - (0.1 - depth / 2)) < 1e-8);
      }
    }
  }
}

TEST_CASE("manifold reduction: the four points kept of many span most of the face") {
  std::vector<Vector3> prism;
  for (int k = 0; k < 64; ++k) {
    const double angle = 2 * M_PI * (k / 2) / 32;
    prism.emplace_back(0.1 * std::cos(angle), 0.1 * std::sin(angle), k % 2 == 0 ? -0.05 : 0.05);
  }
  const Pose X{turn(0.2, Vector3::UnitZ()), {0.1, 0.05, 0.15 - 1e-5}};
  for (const Shape& shape : {Shape(convex_hull(prism)), Shape(Cylinder{0.1, 0.1})}) {
    for (const Shape& ground : {Shape(Box{{1, 1, 0.2}}), Shape(HalfSpace{Vector3::UnitZ(), 0.1})}) {
      const auto contacts = touch(ground, origin, shape, X);
      REQUIRE(contacts.size() == 4);
      std::vector<std::pair<double, Vector3>> round;
      for (const Contact& c : contacts) {
        const Vector3 r = c.p_WC - X.p;
        round.emplace_back(std::atan2(r.y(), r.x()), r);
      }
      std::sort(round.begin(), round.end(),
                [](const auto& x, const auto& y) { return x.first < y.first; });
      double area = 0;
      for (int i = 0; i < 4; ++i)
        area += 0.5 * round[i].second.cross(round[(i + 1) % 4].second).z();
      CHECK(area > 0.9 * 2 * 0.1 * 0.1);  // of the inscribed square
    }
  }
}

TEST_CASE("half-space: the depth is that of the lowest point, for every shape") {
  Random random(12);
  for (const Shape& shape : things_to_put_down()) {
    CAPTURE(shape_name(shape));
    double worst = 0;
    for (int k = 0; k < 1000; ++k) {
      const Pose X_WA = random_pose(random);
      const HalfSpace ground{random.direction(), random.uniform(-0.2, 0.2)};
      const Vector3 n = X_WA.R * ground.normal;
      Pose X_WB = random_pose(random);
      const double depth = random.uniform(-1e-3, 0.02);
      const Vector3 lowest = X_WB * support(shape, -(X_WB.R.transpose() * n));
      X_WB.p += n * (n.dot(X_WA.p) + ground.offset - depth - n.dot(lowest));
      const auto contacts = touch(ground, X_WA, shape, X_WB, 2e-3);
      REQUIRE(!contacts.empty());
      double deepest = -1;
      for (const Contact& c : contacts) deepest = std::max(deepest, c.depth);
      worst = std::max({worst, std::abs(deepest - depth), (contacts[0].n_W - n).norm()});
      const auto flipped = touch(shape, X_WB, ground, X_WA, 2e-3);
      REQUIRE(flipped.size() == contacts.size());
      worst = std::max(worst, (flipped[0].n_W + n).norm());
      CHECK((flipped[0].p_WC - contacts[0].p_WC).norm() < 1e-12);
    }
    CHECK(worst < 1e-12);
  }
}

TEST_CASE("a box flat on a half-space has its 4 lower vertices, with persistent features") {
  std::vector<Contact> before;
  for (int k = 0; k < 100; ++k) {
    const Pose X{turn(0.01 * k, Vector3(1e-4, 2e-4, 1)), {0.01 * k, 0, 0.05 - 1e-4}};
    const auto contacts = touch(HalfSpace{}, origin, Box{{0.2, 0.14, 0.1}}, X);
    REQUIRE(contacts.size() == 4);
    for (std::size_t i = 0; i < 4 && !before.empty(); ++i) {
      CHECK(contacts[i].feature == before[i].feature);
      CHECK((contacts[i].p_WC - before[i].p_WC).norm() < 0.02);
    }
    before = contacts;
  }
}

TEST_CASE("crossings of sides have different features, which persist while the box slides") {
  std::vector<Contact> before;
  for (int k = 0; k < 50; ++k) {  // a rotated box over the corner of another
    const Pose X{turn(0.3 + 1e-3 * k, Vector3::UnitZ()), {0.45 + 1e-3 * k, 0.48, 0.15 - 1e-4}};
    const auto contacts = touch(Box{{1, 1, 0.2}}, origin, Box{{0.2, 0.14, 0.1}}, X);
    REQUIRE(contacts.size() == 4);
    std::set<int> names;
    for (const Contact& c : contacts) names.insert(c.feature);
    CHECK(names.size() == 4);
    for (std::size_t i = 0; i < before.size(); ++i) {
      CHECK(contacts[i].feature == before[i].feature);
      CHECK((contacts[i].p_WC - before[i].p_WC).norm() < 0.01);
    }
    before = contacts;
  }
}

static void check_pile(int count) {
  CollisionWorld world, again;
  Random random(14);
  std::vector<Pose> poses;
  const auto things = things_to_put_down();
  for (int i = 0; i < count; ++i) {
    const Shape& shape = i == 20 ? Shape(HalfSpace{}) : things[i % things.size()];
    const Geometry geometry{"thing", shape, 0};
    world.add(geometry);
    again.add(geometry);
    poses.push_back({random.rotation(), 0.25 * random.direction()});
  }
  std::vector<Contact> contacts, repeated;
  world.detect(poses, 1e-3, contacts);
  CHECK(contacts.size() > 50);
  CHECK(std::is_sorted(contacts.begin(), contacts.end(), [](const Contact& x, const Contact& y) {
    return std::tie(x.a, x.b, x.feature) < std::tie(y.a, y.b, y.feature);
  }));
  // Another world with a different history.
  std::vector<Pose> elsewhere = poses;
  for (Pose& X : elsewhere) X.p = 3 * random.direction();
  again.detect(elsewhere, 1e-3, repeated);
  again.detect(poses, 1e-3, repeated);
  REQUIRE(repeated.size() == contacts.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact &x = contacts[i], &y = repeated[i];
    CHECK(std::tie(x.a, x.b, x.feature, x.depth) == std::tie(y.a, y.b, y.feature, y.depth));
    CHECK((x.p_WC == y.p_WC && x.n_W == y.n_W));
  }
  // Against all pairs: the broad phase loses none.
  std::set<std::pair<int, int>> found, expected;
  for (const Contact& c : contacts) found.emplace(c.a, c.b);
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      if (world.distance(a, b, poses[a], poses[b]) < 0) expected.emplace(a, b);
    }
  }
  CHECK(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
}

TEST_CASE(
    "contacts of a pile are sorted, without duplicate pairs, and bit-identical at every call") {
  for (const int count : {40, 100}) check_pile(count);
}

TEST_CASE("excluded pairs and groups do not collide") {
  CollisionWorld world;
  for (const int group : {0, 0, 0, 1, 2, 2}) world.add({"box", Box{{0.1, 0.1, 0.1}}, group});
  const std::vector<Pose> poses(6);
  std::vector<Contact> contacts;
  const auto pairs = [&] {
    std::set<std::pair<int, int>> found;
    world.detect(poses, 0, contacts);
    for (const Contact& c : contacts) found.emplace(c.a, c.b);
    return found;
  };
  CHECK(pairs().size() == 14);
  CHECK(!pairs().contains({4, 5}));
  world.set_pair_filter([](int a, int b) { return b > 3 || (a == 0 && b == 2); });
  CHECK(pairs() == std::set<std::pair<int, int>>{{0, 1}, {0, 3}, {1, 2}, {1, 3}, {2, 3}});
}

TEST_CASE("geometries of one body do not collide with each other") {
  CollisionWorld world;
  for (const int body : {0, 0, 7, 7, -1, -1}) world.add({"box", Box{{0.1, 0.1, 0.1}}, 0, body});
  std::set<std::pair<int, int>> apart;
  for (int a = 0; a < world.size(); ++a)
    for (int b = a + 1; b < world.size(); ++b)
      if (!world.may_collide(a, b)) apart.emplace(a, b);
  CHECK(apart == std::set<std::pair<int, int>>{{0, 1}, {2, 3}});
}

TEST_CASE("unsupported geometries are rejected when added") {
  CollisionWorld world;
  world.add({"floor", HalfSpace{}, 1});
  CHECK_THROWS_AS(world.add({"wall", HalfSpace{{1, 0, 0}, 0}, 0}), InputError);
  CHECK(world.size() == 1);
  CHECK(world.add({"wall", HalfSpace{{1, 0, 0}, 0}, 1}) == 1);
  CHECK(!world.may_collide(0, 1));
  CHECK_THROWS_AS(world.add({"ball", Sphere{-1}}), InputError);
  CHECK(world.size() == 2);
}

TEST_CASE("a body with an undefined pose has no contacts and does not affect others") {
  CollisionWorld world;
  for (int i = 0; i < 3; ++i) world.add({"box", Box{{0.1, 0.1, 0.1}}, 0});
  std::vector<Pose> poses(3);
  poses[1].p.x() = std::nan("");
  std::vector<Contact> contacts;
  world.detect(poses, 0, contacts);
  REQUIRE(!contacts.empty());
  for (const Contact& c : contacts) CHECK((c.a == 0 && c.b == 2));
}
