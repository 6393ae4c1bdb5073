// Distances of cores of all kinds and sizes: verified by the bounds, and by FCL.
#include "collision/narrow_phase/gjk.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "collision/narrow_phase/narrow_phase.h"
#include "tests/collision/narrow_phase/oracle.h"
#include "tests/collision/shapes/fcl_oracle.h"

using namespace twinarm;
using namespace twinarm::test;

namespace {

// Ordinary, tiny, long, thin and huge sizes.
std::vector<Shape> shapes_of_all_sizes() {
  Random random(7);
  return {Sphere{0.06},
          Box{{0.2, 0.14, 0.1}},
          Capsule{0.05, 0.2},
          Cylinder{0.06, 0.15},
          random_hull(random),
          Ellipsoid{{0.11, 0.05, 0.07}},
          Box{{1e-4, 2e-4, 1e-4}},
          Box{{10, 1e-3, 1e-3}},
          Box{{100, 100, 1}},
          Capsule{1e-3, 3},
          Cylinder{1e-3, 2},
          Cylinder{2, 1e-3},
          Ellipsoid{{1, 1e-2, 1e-2}},
          Ellipsoid{{1e-4, 2e-4, 1e-4}}};
}

// In turn: deep, touching, slightly separated, near, up to 100 m away, aligned on a grid.
struct Poses {
  Pose X_WA, X_WB;
};
Poses poses_of_all_kinds(Random& random, const Shape& a, const Shape& b, int k) {
  Poses x{random_pose(random), {}};
  const auto power = [&](double low, double high) {
    return std::pow(10, random.uniform(low, high));
  };
  const double gap = k % 5 == 0   ? random.uniform(-0.06, 0)
                     : k % 5 == 1 ? power(-12, -2)
                     : k % 5 == 2 ? random.uniform(0, 0.1)
                                  : power(-2, 2);
  if (k % 5 == 4) x.X_WA.R = quarter_turns(random);
  x.X_WB = pushed_against(random, a, x.X_WA, b, gap);
  if (k % 5 != 4) return x;
  x.X_WB.R = quarter_turns(random);
  for (int i = 0; i < 3; ++i)
    x.X_WB.p[i] = x.X_WA.p[i] + 0.01 * std::round(random.uniform(-15, 15));
  return x;
}

// visit(a, b, solid_a, solid_b, random)
template <class Visit>
void for_all_solids(Visit visit) {
  const std::vector<Shape> shapes = shapes_of_all_sizes();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t j = 0; j < shapes.size(); ++j) {
      CAPTURE(i);
      CAPTURE(j);
      Random random(static_cast<unsigned>(41 + i + 100 * j));
      visit(shapes[i], shapes[j], PreparedShape(shapes[i]), PreparedShape(shapes[j]), random);
    }
  }
}

}  // namespace

TEST_CASE("gjk: every distance is verified by the support points along its normal") {
  int apart = 0;
  for_all_solids([&](const Shape& a, const Shape& b, const PreparedShape& solid_a,
                     const PreparedShape& solid_b, Random& random) {
    const double radii = solid_a.core.radius + solid_b.core.radius;
    double gap = 0, points = 0;
    for (int k = 0; k < 200; ++k) {
      const Poses x = poses_of_all_kinds(random, a, b, k);
      const PosedShape placed_a{solid_a, x.X_WA}, placed_b{solid_b, x.X_WB};
      const CoreDistance found = core_distance(placed_a, placed_b);
      if (found.distance == 0) continue;
      ++apart;
      const double scale = 1 + found.distance;
      const double bound = radii - overlap(placed_a, placed_b, found.n_W);
      gap = std::max(gap, (found.distance - bound) / scale);
      const Vector3 between = found.p_WB - found.p_WA;
      points = std::max(points, (between - found.distance * found.n_W).norm() / scale);
    }
    CHECK(gap < 2e-8);
    CHECK(points < 1e-9);
  });
  CHECK(apart > 14 * 14 * 100);
}

TEST_CASE("gjk: FCL never finds a shorter distance, and none for overlapping cores") {
  for_all_solids([](const Shape& a, const Shape& b, const PreparedShape& solid_a,
                    const PreparedShape& solid_b, Random& random) {
    const FclShape fcl_a(a, solid_a.core), fcl_b(b, solid_b.core);
    double longer = 0, lost = 0;
    for (int k = 0; k < 50; ++k) {
      const Poses x = poses_of_all_kinds(random, a, b, k);
      const CoreDistance found = core_distance({solid_a, x.X_WA}, {solid_b, x.X_WB});
      const FclDistance fcl = core_distance(fcl_a, x.X_WA, fcl_b, x.X_WB);
      const double scale = 1 + fcl.distance;
      if (found.distance > 0 && fcl.distance > 0)
        longer = std::max(longer, (found.distance - fcl.distance) / scale);
      if (found.distance == 0) lost = std::max(lost, fcl.distance);
    }
    CHECK(longer < 2e-9);
    CHECK(lost < 1e-8);
  });
}

TEST_CASE("gjk: for overlapping cores no direction separates them") {
  NarrowPhase narrow_phase;
  for_all_solids([&](const Shape& a, const Shape& b, const PreparedShape& solid_a,
                     const PreparedShape& solid_b, Random& random) {
    const double radii = solid_a.core.radius + solid_b.core.radius;
    double parted = 0, unlike = 0;
    for (int k = 0; k < 50; ++k) {
      const Poses x = poses_of_all_kinds(random, a, b, k);
      const PosedShape placed_a{solid_a, x.X_WA}, placed_b{solid_b, x.X_WB};
      const CoreDistance cores = core_distance(placed_a, placed_b);
      const double signed_distance = narrow_phase.distance(placed_a, placed_b);
      if (cores.distance == 0) {
        parted = std::max(parted, signed_distance + radii);
      } else {
        unlike = std::max(
            unlike, std::abs(signed_distance + radii - cores.distance) / (1 + cores.distance));
      }
    }
    CHECK(parted < 1e-8);
    CHECK(unlike < 1e-8);
  });
}

TEST_CASE("gjk: distances beyond `far` are reported as such, others are exact") {
  for_all_solids([](const Shape& a, const Shape& b, const PreparedShape& solid_a,
                    const PreparedShape& solid_b, Random& random) {
    int wrong = 0;
    for (int k = 0; k < 50; ++k) {
      const Poses x = poses_of_all_kinds(random, a, b, k);
      const PosedShape placed_a{solid_a, x.X_WA}, placed_b{solid_b, x.X_WB};
      const double far = 0.01, truth = core_distance(placed_a, placed_b).distance;
      const CoreDistance found = core_distance(placed_a, placed_b, far);
      const double radii = solid_a.core.radius + solid_b.core.radius;
      if (truth > far + 1e-7) {
        wrong += !(found.distance > far) || !(radii - overlap(placed_a, placed_b, found.n_W) > far);
      } else if (truth < far) {
        wrong += found.distance != truth;
      }
    }
    CHECK(wrong == 0);
  });
}
