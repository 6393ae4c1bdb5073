// Heaps of the contact benchmark (benchmarks/scenes/mechanisms.h) before the first step.
#include <doctest/doctest.h>

#include <cmath>

#include "benchmarks/scenes/mechanisms.h"

using namespace twinarm;
using namespace twinarm::bench;

namespace {

Vector3d position(const Scene& scene, std::size_t body) {
  return Vector3d::Map(&scene.q[7 * body]);
}
// Between the walls, the second to the fifth fixed box.
double floor_area(const Scene& scene) {
  const double width = 2 * (scene.fixed_boxes[3].centre.x() - scene.fixed_boxes[3].half.x());
  return width * width;
}
// Half of the longest diagonal.
double bounding_radius(const Body& body) {
  return body.form == Form::sphere ? body.half.x() : body.half.norm();
}

}  // namespace

TEST_CASE("heap: has N bodies inside the container, none of which touch") {
  for (const Form form : {Form::sphere, Form::box})
    for (const int count : {1, 30, 300}) {
      CAPTURE(count);
      const Scene scene = heap(form, count);
      REQUIRE(scene.bodies.size() == static_cast<std::size_t>(count));
      REQUIRE(scene.fixed_boxes.size() == 5);
      const double r = bounding_radius(scene.bodies[0]), a = std::sqrt(floor_area(scene)) / 2;
      const double height = 2 * scene.fixed_boxes[1].half.z();
      for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const Vector3d p = position(scene, i);
        CHECK(scene.bodies[i].form == form);
        CHECK(std::max(std::abs(p.x()), std::abs(p.y())) <= a - r);
        CHECK((p.z() >= r && p.z() <= height - r));
        for (std::size_t j = 0; j < i; ++j) CHECK((p - position(scene, j)).norm() > 2 * r);
      }
    }
}

TEST_CASE("heap: the floor area is proportional to the number of bodies") {
  for (const Form form : {Form::sphere, Form::box})
    for (const int count : {100, 300, 1000, 3000}) {
      CAPTURE(count);
      const double layers = count * 1e-3 / floor_area(heap(form, count));
      CHECK(layers == doctest::Approx(3000e-3 / floor_area(heap(form, 3000))).epsilon(0.25));
    }
}

TEST_CASE("heap: two calls make the same positions and orientations") {
  CHECK(heap(Form::box, 100).q == heap(Form::box, 100).q);
}
