#include "collision/shapes/shape.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "collision/geometry/mass_properties.h"
#include "collision/mesh_files/mesh_file.h"
#include "solver/support/diagnostics.h"
#include "tests/collision/narrow_phase/oracle.h"
#include "tests/support/problem_of.h"

using namespace twinarm;
using namespace twinarm::test;

TEST_CASE("the support point of every bounded shape maximises d . x") {
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

TEST_CASE("shapes with invalid dimensions report the error") {
  CHECK(shape_fault(Sphere{-1}).find("radius") != std::string::npos);
  CHECK(shape_fault(Box{{1, 0, 1}}).find("size") != std::string::npos);
  CHECK(shape_fault(Capsule{0.1, std::nan("")}).find("length") != std::string::npos);
  CHECK(shape_fault(HalfSpace{{0, 0, 2}, 0}).find("normal") != std::string::npos);
  CHECK(!shape_fault(ConvexHull{}).empty());
  CHECK(shape_fault(Cylinder{0.1, 0.2}).empty());
}

TEST_CASE("errors show small numbers by their digits") {
  const auto is_shown = [](const std::string& text) {
    CAPTURE(text);
    return text.find("0.000000") == std::string::npos && text.find("1e-09") != std::string::npos;
  };
  CHECK(is_shown(shape_fault(Sphere{-1e-9})));
  CHECK(is_shown(shape_fault(HalfSpace{{0, 0, 1e-9}, 0})));
  CHECK(is_shown(testing::problem_of([] { check_density(-1e-9); })));
  CHECK(is_shown(testing::problem_of([] {
    with_mass({1, Vector3::Zero(), Matrix3::Zero()}, -1e-9);
  })));
  CHECK(is_shown(testing::problem_of([] {
    combine(std::vector<MassProperties>{{-1e-9, {}, Matrix3::Zero()}});
  })));
  CHECK(is_shown(testing::problem_of([] { load_mesh("none.stl", -1e-9); })));
  CHECK(shape_fault(MeshShape{box_mesh({1e9, 1, 1})}).find("1e+09") != std::string::npos);
}

// Includes shapes that are added to AnyShape.
TEST_CASE("supports, polytopes, boundary features and mass properties of every shape agree") {
  Random random(5);
  for_each_shape([&](const auto& known) {
    const Shape shape = known;
    CAPTURE(shape_name(shape));
    CHECK(shape_fault(shape).empty());
    CHECK(std::string(known.key).find(' ') == std::string::npos);
    const Polytope core = make_polytope(shape);
    const BoundaryFeatures boundary = make_boundary(shape, core);
    for (int k = 0; k < 100 && !boundary.quadrics.empty(); ++k) {
      const Vector3 d = random.direction();
      const double height = support(shape, d).dot(d);
      CHECK(height >= support(shape, random.direction()).dot(d) - 1e-12);
      double highest = -1e300;
      for (const BoundaryFeatures::Quadric& quadric : boundary.quadrics)
        highest = std::max(highest, quadric.p.dot(d) + std::sqrt(d.dot(quadric.Q * d)));
      CHECK(std::abs(highest + boundary.rounding_radius - height) < 1e-12);
    }
    if constexpr (requires { known.solid(1000.0); }) {
      const MassProperties solid = mass_properties(shape, 1000);
      CHECK(solid.mass > 0);
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3 e = Vector3::Unit(axis);
        CHECK(solid.com[axis] < support(shape, e)[axis]);
        CHECK(solid.com[axis] > support(shape, -e)[axis]);
      }
    } else {
      CHECK_THROWS_AS(mass_properties(shape, 1000), InputError);
    }
  });
}
