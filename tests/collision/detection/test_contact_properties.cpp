// Properties of every pair of registered shapes in thousands of random poses.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "collision/detection/collision_world.h"
#include "tests/collision/detection/pair_scene.h"
#include "tests/collision/narrow_phase/oracle.h"

using namespace twinarm;
using namespace twinarm::test;

namespace {

constexpr double kMargin = 5e-3;

// One of each alternative of Shape, at its index.
std::vector<Shape> every_shape() {
  Random random(7);
  std::vector<Shape> shapes = {Sphere{0.06},
                               Box{{0.2, 0.14, 0.1}},
                               Capsule{0.05, 0.2},
                               Cylinder{0.06, 0.15},
                               HalfSpace{Vector3(0.36, 0.48, 0.8), 0.05},
                               random_hull(random),
                               Ellipsoid{{0.11, 0.05, 0.07}},
                               SphericalCavity{0.5},
                               CylindricalCavity{0.5, 2},
                               MeshShape{box_mesh({0.3, 0.25, 0.2})}};
  return shapes;
}

bool is_convex(const Shape& s) {
  return !std::holds_alternative<HalfSpace>(s) && !std::holds_alternative<SphericalCavity>(s) &&
         !std::holds_alternative<CylindricalCavity>(s) && !std::holds_alternative<MeshShape>(s);
}

// B near the surface of A; `b` is convex.
Pose placed_near(Random& random, const Shape& a, const Pose& X_WA, const Shape& b, double gap) {
  if (const auto* ground = std::get_if<HalfSpace>(&a)) {
    const Vector3 n = X_WA.R * ground->normal;
    Pose X_WB = random_pose(random);
    const Vector3 lowest = X_WB * support(b, -(X_WB.R.transpose() * n));
    X_WB.p += n * (n.dot(X_WA.p) + ground->offset + gap - n.dot(lowest));
    return X_WB;
  }
  if (std::holds_alternative<SphericalCavity>(a) || std::holds_alternative<CylindricalCavity>(a)) {
    Pose X_AB{random.rotation(), Vector3::Zero()};
    const double angle = random.uniform(-3, 3);
    const Vector3 out(std::cos(angle), std::sin(angle), 0);
    X_AB.p = out * (0.5 - out.dot(X_AB.R * support(b, X_AB.R.transpose() * out)) - gap);
    return X_WA * X_AB;
  }
  return pushed_against(random, a, X_WA, b, gap);
}

template <class Visit>
void for_all_pairs(Visit visit) {
  const std::vector<Shape> shapes = every_shape();
  REQUIRE(shapes.size() == std::variant_size_v<Shape>);
  for (const Shape& a : shapes) {
    for (const Shape& b : shapes) {
      if (!is_convex(b) || !is_supported(a, b)) continue;
      CAPTURE(shape_name(a));
      CAPTURE(shape_name(b));
      visit(a, b);
    }
  }
}

}  // namespace

TEST_CASE("every pair: contacts do not depend on the world's origin") {
  for_all_pairs([](const Shape& a, const Shape& b) {
    Random random(61);
    PairScene pair(a, b, kMargin);
    double depth = 0, place = 0, normal = 0;
    int other_count = 0;
    for (int k = 0; k < 300; ++k) {
      const Pose X_WA = random_pose(random);
      const Pose X_WB = placed_near(random, a, X_WA, b, random.uniform(-2e-3, 2e-3));
      const Pose X_VW{random.rotation(), random.direction()};
      const std::vector<Contact> before = pair.touch(X_WA, X_WB);
      const std::vector<Contact>& after = pair.touch(X_VW * X_WA, X_VW * X_WB);
      if (before.size() != after.size()) ++other_count;
      for (const Contact& x : before) {
        for (const Contact& y : after) {
          if (x.feature != y.feature) continue;
          depth = std::max(depth, std::abs(x.depth - y.depth));
          place = std::max(place, (X_VW * x.p_WC - y.p_WC).norm());
          normal = std::max(normal, (X_VW.R * x.n_W - y.n_W).norm());
        }
      }
    }
    CHECK(other_count == 0);
    CHECK(depth < 1e-9);
    CHECK(place < 1e-6);
    CHECK(normal < 1e-6);
  });
}

TEST_CASE("every pair: swapped roles give the same contacts with opposite normals") {
  for_all_pairs([](const Shape& a, const Shape& b) {
    Random random(62);
    PairScene ab(a, b, kMargin), ba(b, a, kMargin);
    double depth = 0, normal = 0, place = 0;
    for (int k = 0; k < 300; ++k) {
      const Pose X_WA = random_pose(random);
      const Pose X_WB = placed_near(random, a, X_WA, b, random.uniform(-2e-3, 2e-3));
      ab.touch(X_WA, X_WB);
      ba.touch(X_WB, X_WA);
      REQUIRE(ab.contacts.empty() == ba.contacts.empty());
      if (ab.contacts.empty()) continue;
      depth = std::max(depth, std::abs(ab.deepest().depth - ba.deepest().depth));
      normal = std::max(normal, (ab.deepest().n_W + ba.deepest().n_W).norm());
      place = std::max(place, ab.contacts.size() == 1 && ba.contacts.size() == 1
                                  ? (ab.contacts[0].p_WC - ba.contacts[0].p_WC).norm()
                                  : 0.0);
    }
    CHECK(depth < 1e-9);
    CHECK(normal < 1e-5);
    CHECK(place < 1e-5);
  });
}

TEST_CASE("every pair, along short motions: depths never jump and normals never flip") {
  for_all_pairs([](const Shape& a, const Shape& b) {
    Random random(63);
    PairScene pair(a, b, kMargin);
    const double step = 1e-5, reach = 0.25;  // no point of B is farther from its origin [m]
    double excess = 0;
    int flips = 0;
    for (int k = 0; k < 150; ++k) {
      const Pose X_WA = random_pose(random);
      Pose X_WB = placed_near(random, a, X_WA, b, random.uniform(-5e-4, 2e-3));
      const Vector3 axis = random.direction(), way = random.direction();
      double depth = 0;
      Vector3 normal = Vector3::Zero();
      for (int i = 0; i < 40; ++i) {
        X_WB.R = Eigen::AngleAxisd(step / reach, axis).toRotationMatrix() * X_WB.R;
        X_WB.p += step * way;
        if (pair.touch(X_WA, X_WB).empty()) {
          normal.setZero();
          continue;
        }
        const Contact& now = pair.deepest();
        if (!normal.isZero(0)) {
          excess = std::max(excess, std::abs(now.depth - depth) - 2 * step * (1 + 1e-6));
          if (now.n_W.dot(normal) < 0) ++flips;
        }
        depth = now.depth;
        normal = now.n_W;
      }
    }
    CHECK(excess < 1e-9);
    CHECK(flips == 0);
  });
}

TEST_CASE("every pair: the features of contacts persist while a body slides") {
  for_all_pairs([](const Shape& a, const Shape& b) {
    Random random(64);
    PairScene pair(a, b, kMargin);
    int steps = 0, renamed = 0;
    for (int k = 0; k < 5000 && steps < 1000; ++k) {
      const Pose X_WA = random_pose(random);
      Pose X_WB = placed_near(random, a, X_WA, b, -1e-3);
      if (pair.touch(X_WA, X_WB).empty()) continue;
      const Vector3 across = pair.deepest().n_W.unitOrthogonal();
      std::set<int> names;
      for (const Contact& c : pair.contacts) names.insert(c.feature);
      for (int i = 0; i < 20; ++i) {
        X_WB.p += 1e-6 * across;
        if (pair.touch(X_WA, X_WB).empty()) break;
        ++steps;
        if (!names.contains(pair.deepest().feature)) ++renamed;
        names.clear();
        for (const Contact& c : pair.contacts) names.insert(c.feature);
      }
    }
    CHECK(steps >= 1000);
    CHECK(renamed <= steps / 200);  // at an edge
  });
}

TEST_CASE("every pair: detection is bit-identical whatever was queried before") {
  for_all_pairs([](const Shape& a, const Shape& b) {
    Random random(65);
    PairScene pair(a, b, kMargin);
    const Pose X_WA = random_pose(random), X_WB = placed_near(random, a, X_WA, b, -1e-4);
    const std::vector<Contact> before = pair.touch(X_WA, X_WB);
    pair.touch(X_WA, placed_near(random, a, X_WA, b, -2e-3));
    const std::vector<Contact>& after = pair.touch(X_WA, X_WB);
    REQUIRE(before.size() == after.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      CHECK(before[i].feature == after[i].feature);
      CHECK(before[i].depth == after[i].depth);
      CHECK((before[i].p_WC == after[i].p_WC && before[i].n_W == after[i].n_W));
    }
  });
}
