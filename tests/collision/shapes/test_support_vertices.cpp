// Vectorised support index against a plain loop.
#include <doctest/doctest.h>

#include <limits>
#include <random>
#include <vector>

#include "collision/geometry/mesh.h"

namespace twinarm {
namespace {

std::size_t one_by_one(const std::vector<Vector3>& points, const Vector3& d) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i].dot(d) > points[best].dot(d)) best = i;
  return best;
}

TEST_CASE("the support index is that of the first point with the maximum") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::uniform_int_distribution<int> few(-2, 2);
  for (const int count : {1, 2, 31, 32, 33, 170}) {
    std::vector<Vector3> points, corners;  // vertices of a cube: many ties
    for (int i = 0; i < count; ++i) {
      points.emplace_back(normal(random), normal(random), normal(random));
      corners.emplace_back(few(random), few(random), few(random));
    }
    const SupportVertices of_points(points), of_corners(corners);
    for (int k = 0; k < 500; ++k) {
      const Vector3 d(normal(random), normal(random), normal(random));
      CHECK(of_points.support_index(d) == one_by_one(points, d));
      const Vector3 along(few(random), few(random), few(random));
      CHECK(of_corners.support_index(along) == one_by_one(corners, along));
    }
  }
}

TEST_CASE("the support index of a NaN direction is 0") {
  const std::vector<Vector3> points(40, Vector3::Ones());
  const Vector3 d = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  CHECK(SupportVertices(points).support_index(d) == 0);
}

}  // namespace
}  // namespace twinarm
