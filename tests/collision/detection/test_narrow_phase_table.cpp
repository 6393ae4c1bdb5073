// The table of docs/understand/narrow_phases.md: our narrow phase and FCL's, pair by pair. Printed,
// with times and 2000 poses of each pair, if TWINARM_TABLE is set.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "collision/detection/collision_world.h"
#include "tests/collision/detection/pair_scene.h"
#include "tests/collision/narrow_phase/oracle.h"

using namespace twinarm;
using namespace twinarm::test;

namespace {

struct Depths {
  const char* name;
  double low, high;  // [m]
};
constexpr std::array all_depths{Depths{"1 mm apart to 1 mm deep", -1e-3, 1e-3},
                                Depths{"1 to 20 mm deep", 1e-3, 2e-2}};

std::vector<Shape> shapes_of_table() {
  std::vector<Vector3> icosahedron;
  for (const double i : {-0.05, 0.05})
    for (const double j : {-0.081, 0.081})
      for (const Vector3& v : {Vector3(0, i, j), Vector3(i, j, 0), Vector3(j, 0, i)})
        icosahedron.push_back(v);
  return {Sphere{0.06},
          Capsule{0.05, 0.2},
          Box{{0.2, 0.14, 0.1}},
          Cylinder{0.06, 0.15},
          Ellipsoid{{0.11, 0.05, 0.07}},
          convex_hull(icosahedron)};
}

// In random directions and rotations, moved along the normal to a depth of the range.
std::array<Pose, 2> pose_in(const Depths& range, Random& random, PairScene& own) {
  std::array<Pose, 2> X{random_pose(random), random_pose(random)};
  X[1].p = X[0].p + random.direction();
  const double goal = random.uniform(range.low, range.high);
  for (int k = 0; k < 30; ++k) {
    own.touch(X[0], X[1], 2.0);
    X[1].p += (own.depth() - goal) * own.deepest().n_W;
  }
  return X;
}

double seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Of one detection with contact points, the median of nine in turn [us]
std::array<double, 2> times(const std::vector<std::array<Pose, 2>>& poses, PairScene& own,
                            PairScene& fcl) {
  std::array<std::array<double, 9>, 2> all{};
  const std::array<PairScene*, 2> scenes{&own, &fcl};
  for (std::size_t k = 0; k < 9; ++k)
    for (std::size_t i = 0; i < 2; ++i) {
      const double start = seconds();
      for (const auto& X : poses) scenes[i]->touch(X[0], X[1]);
      all[i][k] = 1e6 * (seconds() - start) / static_cast<double>(poses.size());
    }
  for (auto& of_one : all) std::ranges::sort(of_one);
  return {all[0][4], all[1][4]};
}

struct Row {
  double depth = 0, normal = 0;  // largest differences of FCL's answers
  std::size_t answered = 0;
};

Row measure(const Shape& a, const Shape& b, const Depths& range, std::size_t count, bool prints) {
  Random random(1);
  PairScene own(a, b, 5e-3), fcl(a, b, 5e-3);
  fcl.world.use_fcl();
  Row row;
  std::vector<std::array<Pose, 2>> poses;
  for (std::size_t k = 0; k < count; ++k) {
    const auto& X = poses.emplace_back(pose_in(range, random, own));
    const std::size_t rejected = fcl.world.fcl_use().rejected;
    own.touch(X[0], X[1]);
    REQUIRE(!fcl.touch(X[0], X[1]).empty());
    if (fcl.world.fcl_use().rejected > rejected) continue;
    ++row.answered;
    row.depth = std::max(row.depth, std::abs(fcl.depth() - own.depth()));
    row.normal = std::max(row.normal, (fcl.deepest().n_W - own.deepest().n_W).norm());
  }
  if (!prints) return row;
  poses.resize(count / 4);
  const auto [t_own, t_fcl] = times(poses, own, fcl);
  std::printf("| %s, %s | %.3g %% | %.1e | %.1e | %.2g | %.2g |\n", shape_name(a).c_str(),
              shape_name(b).c_str(),
              100.0 * static_cast<double>(row.answered) / static_cast<double>(count), row.depth,
              row.normal, t_own, t_fcl);
  return row;
}

}  // namespace

TEST_CASE("FCL: depths differ from ours by 2 mm at most, of spheres and capsules by 2 um") {
  const bool prints = std::getenv("TWINARM_TABLE") != nullptr;
  const std::vector<Shape> shapes = shapes_of_table();
  for (const Depths& range : all_depths) {
    if (prints) std::printf("\n%s\n", range.name);
    for (std::size_t i = 0; i < shapes.size(); ++i)
      for (std::size_t j = i; j < shapes.size(); ++j) {
        CAPTURE(shape_name(shapes[i]));
        CAPTURE(shape_name(shapes[j]));
        CAPTURE(range.name);
        const Row row = measure(shapes[i], shapes[j], range, prints ? 2000 : 60, prints);
        const bool is_round = i < 2, are_boxes = i == 2 && j == 2;
        CHECK(row.depth < (is_round ? 2e-6 : 2e-3));
        CHECK(row.normal < (is_round ? 0.01 : 2));
        if (is_round || are_boxes || range.low < 0) CHECK(row.answered >= (are_boxes ? 54 : 58));
      }
  }
}
