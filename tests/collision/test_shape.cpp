#include "collision/shapes/shape.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "tests/collision/oracle.h"

using namespace twinarm;
using namespace twinarm::test;

TEST_CASE("the support of every bounded shape is its highest point along a direction") {
  Random random(6);
  const std::vector<Shape> shapes = {Sphere{0.06}, Box{{0.2, 0.14, 0.1}}, Capsule{0.05, 0.2},
                                     Cylinder{0.06, 0.15}, random_hull(random)};
  for (const Shape& shape : shapes) {
    CAPTURE(shape_name(shape));
    for (int k = 0; k < 500; ++k) {
      const Vector3 d = random.uniform(0.1, 10) * random.direction();
      const double height = support(shape, d).dot(d.normalized());
      double oracle = -1e300;
      for (const Vector3& v : core_vertices(shape))
        oracle = std::max(oracle, v.dot(d.normalized()));
      oracle += core_radius(shape);
      const double sagitta = std::holds_alternative<Cylinder>(shape) ? 1.5e-4 : 0;
      CHECK(height > oracle - 1e-14);
      CHECK(height < oracle + sagitta + 1e-14);
    }
  }
}

TEST_CASE("shapes with impossible numbers say what is wrong") {
  CHECK(shape_fault(Sphere{-1}).find("radius") != std::string::npos);
  CHECK(shape_fault(Box{{1, 0, 1}}).find("size") != std::string::npos);
  CHECK(shape_fault(Capsule{0.1, std::nan("")}).find("length") != std::string::npos);
  CHECK(shape_fault(HalfSpace{{0, 0, 2}, 0}).find("normal") != std::string::npos);
  CHECK(!shape_fault(ConvexHull{}).empty());
  CHECK(shape_fault(Cylinder{0.1, 0.2}).empty());
}
