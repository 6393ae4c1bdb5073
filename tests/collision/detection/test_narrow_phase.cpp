// All pairs of bounded shapes in thousands of random poses against the Minkowski oracle.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "collision/detection/collision_world.h"
#include "tests/collision/detection/pair_scene.h"
#include "tests/collision/narrow_phase/oracle.h"

using namespace twinarm;
using namespace twinarm::test;

namespace {

constexpr double kWideMargin = 0.01;

std::vector<Shape> bounded_shapes() {
  Random random(7);
  return {Sphere{0.06},
          Box{{0.2, 0.14, 0.1}},
          Capsule{0.05, 0.2},
          Cylinder{0.06, 0.15},
          random_hull(random),
          Box{{0.3, 0.02, 0.05}},
          Ellipsoid{{0.11, 0.05, 0.07}},
          Cylinder{0.1, 0.004}};
}

bool is_ellipsoid(const Shape& s) {
  return std::holds_alternative<Ellipsoid>(s);
}
bool has_curved(const Shape& a, const Shape& b) {
  return std::holds_alternative<Cylinder>(a) || std::holds_alternative<Cylinder>(b) ||
         is_ellipsoid(a) || is_ellipsoid(b);
}

// Maximum deviations over a run.
struct Worst {
  void see(double error) { value = std::max(value, std::isfinite(error) ? error : 1e300); }
  double value = 0;
};

template <class Visit>
void for_bounded_pairs(Visit visit) {
  const std::vector<Shape> shapes = bounded_shapes();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t j = i; j < shapes.size(); ++j) {
      CAPTURE(shape_name(shapes[i]));
      CAPTURE(shape_name(shapes[j]));
      visit(shapes[i], shapes[j]);
    }
  }
}

Pose nudged(Random& random, const Pose& X, double shift, double turn) {
  return {Eigen::AngleAxisd(turn, random.direction()).toRotationMatrix() * X.R,
          X.p + shift * random.direction()};
}

}  // namespace

TEST_CASE(
    "polytope pairs: distance, depth and existence of contacts agree with the oracle to 1e-8") {
  for_bounded_pairs([](const Shape& a, const Shape& b) {
    const bool round = core_vertices(a).size() + core_vertices(b).size() <= 4;  // no volume
    if (has_curved(a, b) || round) return;
    Random random(11);
    PairScene pair(a, b, kWideMargin);
    Worst distance, depth;
    int wrong = 0;
    for (int k = 0; k < 400; ++k) {
      const Pose X_WA = random_pose(random);
      const Pose X_WB = pushed_against(random, a, X_WA, b, random.uniform(-0.06, 0.02));
      const double truth = oracle_distance(a, X_WA, b, X_WB);
      distance.see(std::abs(pair.world.distance(0, 1, X_WA, X_WB) - truth));
      if (pair.touch(X_WA, X_WB).empty() != (truth >= kWideMargin)) ++wrong;
      if (!pair.contacts.empty()) depth.see(std::abs(pair.depth() + truth));
    }
    CHECK(distance.value < 1e-8);
    CHECK(depth.value < 1e-8);
    CHECK(wrong == 0);
  });
}

TEST_CASE("capsule-capsule: distance and depth agree with a search over one centre line to 1e-8") {
  Random random(13);
  const Capsule a{0.05, 0.2}, b{0.03, 0.3};
  PairScene pair(a, b, kWideMargin);
  Worst distance, depth;
  for (int k = 0; k < 5000; ++k) {
    const Pose X_WA = random_pose(random);
    const Pose X_WB = pushed_against(random, a, X_WA, b, random.uniform(-0.05, 0.02));
    const Vector3 p = X_WB * Vector3(0, 0, -0.15), q = X_WB * Vector3(0, 0, 0.15);
    const auto from_b = [&](double z) {  // convex in z: ternary search
      const Vector3 x = X_WA * Vector3(0, 0, z);
      const double t = std::clamp((x - p).dot(q - p) / (q - p).squaredNorm(), 0.0, 1.0);
      return (x - p - t * (q - p)).norm();
    };
    double low = -0.1, high = 0.1;
    for (int i = 0; i < 200; ++i) {
      const double third = (high - low) / 3;
      (from_b(low + third) < from_b(high - third) ? high : low) +=
          from_b(low + third) < from_b(high - third) ? -third : third;
    }
    const double truth = from_b((low + high) / 2) - 0.08;
    distance.see(std::abs(pair.world.distance(0, 1, X_WA, X_WB) - truth));
    if (!pair.touch(X_WA, X_WB).empty()) depth.see(std::abs(pair.depth() + truth));
  }
  CHECK(distance.value < 1e-8);
  CHECK(depth.value < 1e-8);
}

TEST_CASE("cylinder pairs: distance agrees with a 48-gon prism, depth is a close upper bound") {
  for_bounded_pairs([](const Shape& a, const Shape& b) {
    if (!has_curved(a, b) || is_ellipsoid(a) || is_ellipsoid(b)) return;
    Random random(17);
    PairScene pair(a, b, kWideMargin);
    Worst apart, too_shallow, too_deep;
    for (int k = 0; k < 40; ++k) {
      const Pose X_WA = random_pose(random);
      const Pose X_WB = pushed_against(random, a, X_WA, b, random.uniform(-0.03, 0.01));
      const double truth = oracle_distance(a, X_WA, b, X_WB);
      const double found = pair.world.distance(0, 1, X_WA, X_WB);
      if (truth > 0) {
        apart.see(std::abs(found - truth));
      } else {
        too_shallow.see(found - truth);
        too_deep.see(truth - found);
      }
    }
    const double sagitta = 2 * 0.1 * (1 - std::cos(3.15 / 48));  // of both prisms
    CHECK(apart.value < sagitta);
    CHECK(too_shallow.value < 1e-8);
    CHECK(too_deep.value < sagitta);
  });
}

TEST_CASE("moving b by the depth along the normal separates the bodies") {
  for_bounded_pairs([](const Shape& a, const Shape& b) {
    Random random(19);
    PairScene pair(a, b, kWideMargin);
    Worst length;
    int still_touching = 0, wrong_way = 0;
    for (int k = 0; k < 1000; ++k) {
      const Pose X_WA = random_pose(random);
      Pose X_WB = pushed_against(random, a, X_WA, b, random.uniform(-0.06, 0.01));
      if (pair.touch(X_WA, X_WB).empty()) continue;
      const Vector3 n = pair.contacts[0].n_W;
      length.see(std::abs(n.norm() - 1));
      const double clearance = 1e-9;
      X_WB.p += (pair.depth() + clearance) * n;
      if (!(pair.world.distance(0, 1, X_WA, X_WB) > 0)) ++still_touching;
      X_WB.p -= 2 * clearance * n;
      if (pair.world.distance(0, 1, X_WA, X_WB) > 1e-3) ++wrong_way;
    }
    CHECK(length.value < 1e-12);
    CHECK(still_touching == 0);
    CHECK(wrong_way == 0);
  });
}

TEST_CASE("swapping the roles flips the normal and keeps depths and points") {
  for_bounded_pairs([](const Shape& a, const Shape& b) {
    Random random(23);
    PairScene ab(a, b, kWideMargin), ba(b, a, kWideMargin);
    Worst depth, normal;
    for (int k = 0; k < 500; ++k) {
      const Pose X_WA = random_pose(random);
      const Pose X_WB = pushed_against(random, a, X_WA, b, random.uniform(-0.02, 0.01));
      if (ab.touch(X_WA, X_WB).empty()) continue;
      REQUIRE(!ba.touch(X_WB, X_WA).empty());
      depth.see(std::abs(ab.depth() - ba.depth()));
      normal.see((ab.contacts[0].n_W + ba.contacts[0].n_W).norm());
    }
    CHECK(depth.value < 1e-8);
    CHECK(normal.value < 1e-5);
  });
}

TEST_CASE("the depth changes by no more than the bodies move") {
  for_bounded_pairs([](const Shape& a, const Shape& b) {
    Random random(29);
    PairScene pair(a, b, kWideMargin);
    Worst excess;
    const double step = 1e-5, reach = 0.25;  // [m]: no point of these bodies is farther out
    for (int k = 0; k < 200; ++k) {
      const Pose X_WA = random_pose(random);
      Pose X_WB = pushed_against(random, a, X_WA, b, random.uniform(-0.003, 0.003));
      double before = -pair.world.distance(0, 1, X_WA, X_WB);
      for (int i = 0; i < 20; ++i) {
        X_WB = nudged(random, X_WB, step, step / reach);
        pair.touch(X_WA, X_WB);
        const double now = pair.contacts.empty() ? -kWideMargin : pair.depth();
        if (i > 0 && before > -kWideMargin && now > -kWideMargin)
          excess.see(std::abs(now - before) - 2 * step);
        before = now;
      }
    }
    CHECK(excess.value < 1e-8);
  });
}

TEST_CASE("rotations by exact right angles, touching, are no special case") {
  for_bounded_pairs([](const Shape& a, const Shape& b) {
    const bool round = core_vertices(a).size() + core_vertices(b).size() <= 4;
    if (has_curved(a, b) || round) return;
    Random random(31);
    PairScene pair(a, b, kWideMargin);
    Worst distance;
    for (int k = 0; k < 300; ++k) {
      const Pose X_WA{quarter_turns(random), Vector3::Zero()};
      Pose X_WB{quarter_turns(random), Vector3::Zero()};
      for (int i = 0; i < 3; ++i) X_WB.p[i] = 0.01 * std::round(random.uniform(-15, 15));
      const double truth = oracle_distance(a, X_WA, b, X_WB);
      distance.see(std::abs(pair.world.distance(0, 1, X_WA, X_WB) - truth));
    }
    CHECK(distance.value < 1e-8);
  });
}

TEST_CASE(
    "curved pairs: no direction, sampled and refined, has a smaller overlap than the normal") {
  for_bounded_pairs([](const Shape& a, const Shape& b) {
    if (!has_curved(a, b)) return;
    Random random(37);
    PairScene pair(a, b, kWideMargin);
    const PreparedShape solid_a(a), solid_b(b);
    Worst along_normal, beaten;
    for (int k = 0; k < 200; ++k) {
      const Pose X_WA = random_pose(random);
      const Pose X_WB = pushed_against(random, a, X_WA, b, random.uniform(-0.08, 0.01));
      const PosedShape placed_a{solid_a, X_WA}, placed_b{solid_b, X_WB};
      if (pair.touch(X_WA, X_WB).empty()) continue;
      const double depth = pair.depth();
      along_normal.see(std::abs(overlap(placed_a, placed_b, pair.contacts[0].n_W) - depth));
      beaten.see(depth - sampled_depth(random, placed_a, placed_b));
    }
    CHECK(along_normal.value < 1e-10);
    CHECK(beaten.value < 1e-9);
  });
}

// Each has a minimum next to the kink along an axis, or two adjacent minima: errors of up to 3 mm
// in an earlier version.
TEST_CASE("deeply overlapping cylinders: poses with a minimum that is hard to find") {
  struct Found {
    Shape b;
    Eigen::Quaterniond turn;
    Vector3 p_AB;
  };
  const Cylinder drum{0.06, 0.15}, disc{0.1, 0.004};
  const std::vector<Found> all = {
      {drum, {0.964894, 0.218032, 0.139000, -0.046043}, {-0.061754, -0.041482, 0.130180}},
      {drum, {0.151477, -0.682534, 0.714905, 0.010573}, {0.010065, -0.062010, 0.129195}},
      {drum, {0.089264, 0.009005, 0.078661, 0.992856}, {0.064296, -0.026918, 0.138114}},
      {drum, {0.363205, -0.017019, -0.031127, 0.931034}, {0.023427, -0.077330, 0.132942}},
      {drum, {0.035869, 0.966212, -0.254811, 0.014777}, {0.061786, 0.097576, 0.139907}},
      {drum, {-0.020406, 0.866948, -0.462298, -0.185108}, {0.058305, 0.042807, 0.161162}},
      {disc, {0.475823, -0.126625, 0.028421, 0.869914}, {-0.062464, -0.114885, -0.061466}},
      {disc, {-0.069801, 0.880621, -0.467855, -0.027337}, {0.099975, -0.035612, 0.064993}},
      {disc, {0.001796, 0.026692, 0.996559, -0.078446}, {0.092408, -0.075757, 0.067700}}};
  Random random(53);
  for (std::size_t i = 0; i < all.size(); ++i) {
    CAPTURE(i);
    PairScene pair(drum, all[i].b, kWideMargin);
    const PreparedShape solid_a(drum), solid_b(all[i].b);
    const Pose X_WA, X_WB{all[i].turn.normalized().toRotationMatrix(), all[i].p_AB};
    const double depth = -pair.world.distance(0, 1, X_WA, X_WB);
    CHECK(depth < sampled_depth(random, {solid_a, X_WA}, {solid_b, X_WB}) + 1e-9);
    CHECK(depth > 1e-3);
  }
}
