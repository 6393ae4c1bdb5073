#include "collision/geometry/convex_hull.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "collision/mesh_files/mesh_file.h"
#include "solver/support/diagnostics.h"
#include "tests/collision/narrow_phase/oracle.h"

using namespace twinarm;
using namespace twinarm::test;

namespace {

double highest_outside(const ConvexHull& hull, const std::vector<Vector3>& points) {
  double worst = -1e300;
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    for (const Vector3& p : points)
      worst = std::max(worst, hull.normals[f].dot(p) - hull.offsets[f]);
  }
  return worst;
}

}  // namespace

TEST_CASE("a cube with points inside and on its sides has 8 vertices and 6 square faces") {
  Random random(1);
  std::vector<Vector3> points = box_mesh({2, 2, 2}).vertices;
  for (int i = 0; i < 200; ++i) {
    Vector3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (i % 2 == 0) p[i % 3] = 1;
    points.push_back(p);
  }
  const ConvexHull hull = convex_hull(points);
  CHECK(hull.vertices.size() == 8);
  REQUIRE(hull.faces.size() == 6);
  for (const auto& face : hull.faces) CHECK(face.size() == 4);
  CHECK(hull.triangles.size() == 12);
}

TEST_CASE("a rotated cube from single-precision coordinates still has 6 faces") {
  Random random(2);
  for (int k = 0; k < 100; ++k) {
    std::vector<Vector3> points = moved(box_mesh({0.2, 0.1, 0.3}), random_pose(random)).vertices;
    for (Vector3& p : points) p = p.cast<float>().cast<double>();
    CHECK(convex_hull(points).faces.size() == 6);
  }
}

TEST_CASE("no point of a random cloud is outside a plane, and the planes are tight") {
  Random random(3);
  for (int k = 0; k < 50; ++k) {
    std::vector<Vector3> points;
    for (int i = 0; i < 200; ++i)
      points.push_back(random.direction() * std::cbrt(random.uniform(0, 1)));
    const ConvexHull hull = convex_hull(points);
    CHECK(highest_outside(hull, points) == 0);
    double looseness = 0;  // distance of a face's vertices from its plane
    for (std::size_t f = 0; f < hull.faces.size(); ++f) {
      for (int v : hull.faces[f])
        looseness = std::max(looseness, hull.offsets[f] - hull.normals[f].dot(hull.vertices[v]));
    }
    CHECK(looseness < 1e-6);
  }
}

TEST_CASE("the triangles of a hull are a closed outward surface, with V - E + F = 2") {
  Random random(4);
  for (int k = 0; k < 50; ++k) {
    const ConvexHull hull = random_hull(random);
    CHECK(is_closed({hull.vertices, hull.triangles}));
    const std::size_t sides = std::accumulate(
        hull.faces.begin(), hull.faces.end(), std::size_t{0},
        [](std::size_t sum, const std::vector<int>& face) { return sum + face.size(); });
    CHECK(hull.vertices.size() + hull.faces.size() == sides / 2 + 2);
    for (std::size_t f = 0; f < hull.faces.size(); ++f) CHECK(hull.offsets[f] > 0);
  }
}

TEST_CASE("the hull of a ball of 13,000 points has its flat quadrilaterals as faces") {
  constexpr int kRings = 82, kAround = 164;
  std::vector<Vector3> points = {{0, 0, 1}, {0, 0, -1}};
  for (int ring = 1; ring < kRings; ++ring)
    for (int k = 0; k < kAround; ++k) {
      const double polar = std::numbers::pi * ring / kRings,
                   azimuth = 2 * std::numbers::pi * k / kAround;
      points.emplace_back(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                          std::cos(polar));
    }
  const ConvexHull hull = convex_hull(points);
  CHECK(hull.vertices.size() == points.size());
  CHECK(hull.faces.size() == kRings * kAround);
  CHECK(is_closed({hull.vertices, hull.triangles}));
  CHECK(highest_outside(hull, points) == 0);
}

TEST_CASE("opposite parallel faces are one slab") {
  const std::vector<Polytope::Slab> of_box =
      convex_hull(box_mesh({0.2, 0.4, 0.6}).vertices).polytope().slabs;
  REQUIRE(of_box.size() == 3);
  for (const Polytope::Slab& slab : of_box) {
    CHECK(slab.is_double);
    CHECK(slab.high == slab.normal.cwiseAbs().dot(Vector3(0.1, 0.2, 0.3)));
    CHECK(slab.low == -slab.high);
  }
  const std::vector<Vector3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<Polytope::Slab> of_corner = convex_hull(corners).polytope().slabs;
  REQUIRE(of_corner.size() == 4);
  for (const Polytope::Slab& slab : of_corner) CHECK(!slab.is_double);
}

TEST_CASE("points without a volume are rejected with a fix") {
  const std::vector<Vector3> flat = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.2, 0}};
  const std::vector<Vector3> few = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Vector3> same(5, Vector3(1, 2, 3));
  std::vector<Vector3> bad = box_mesh({1, 1, 1}).vertices;
  bad[3].x() = std::nan("");
  for (const auto& points : {flat, few, same, bad}) {
    try {
      convex_hull(points);
      FAIL("no error");
    } catch (const InputError& error) {
      CHECK(!error.faults().at(0).problem.empty());
      CHECK(!error.faults().at(0).fix.empty());
    }
  }
}
