// Cameras, checked with the painter's projection.
#include <doctest/doctest.h>

#include <random>

#include "app/draw/scene_view.h"
#include "app/render/list/view.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {
namespace {

constexpr int kWide = 1280, kHigh = 720;

Extent random_extent(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> at(-1, 1);
  const Vector3 size(0.1 + std::abs(at(random)), 0.1 + std::abs(at(random)),
                     0.1 + std::abs(at(random)));
  const Vector3 middle = 5 * Vector3(at(random), at(random), at(random));
  Extent extent;
  for (int i = 0; i < 60; ++i)
    extent.add(middle + size.cwiseProduct(Vector3(at(random), at(random), at(random))));
  return extent;
}

// Largest distance of a point from the picture's centre; 1: its border.
double reach(const Camera& camera, const Extent& extent) {
  SceneBounds bounds;
  bounds.all = bounds.solid = {extent.center(), extent.radius()};
  const auto clip = make_clip_from_world(camera, double{kWide} / kHigh, bounds, 1.0);
  double farthest = 0;
  for (const Vector3& p : extent.points()) {
    const auto pixel = project(clip, p, kWide, kHigh);
    REQUIRE(pixel);
    farthest = std::max(
        {farthest, std::abs(2 * pixel->x() / kWide - 1), std::abs(2 * pixel->y() / kHigh - 1)});
  }
  return farthest;
}

const char* const kBall = R"(
[[body]]
name = "ball"
shape = { sphere = { radius = 0.1 } }
mass = 1
)";

TEST_CASE("framing: all points are in the picture, and one is at its margin, from any side") {
  for (unsigned seed = 1; seed <= 40; ++seed)
    for (const char* name : {"auto", "front", "side", "top", "iso", "123,-40", "10,90", "0,-90"}) {
      CAPTURE(seed);
      CAPTURE(name);
      const Extent extent = random_extent(seed);
      const CameraWish wish = parse_camera(name, built(kBall).model);
      const Camera camera = make_camera(wish, extent, double{kWide} / kHigh);
      CHECK(reach(camera, extent) == doctest::Approx(1 / kFrameMargin).epsilon(1e-9));
      CameraWish wide = wish;
      wide.field_of_view = 1;
      const Camera near = make_camera(wide, extent, double{kWide} / kHigh);
      CHECK(reach(near, extent) == doctest::Approx(1 / kFrameMargin).epsilon(1e-9));
    }
}

TEST_CASE(
    "framing: x is to the right in the front view, y in the side view, both as usual in the top "
    "view") {
  const Extent extent = random_extent(7);
  const Model<double> model = built(kBall).model;
  const auto pixel_of = [&](const char* name, const Vector3& p) {
    const Camera camera = make_camera(parse_camera(name, model), extent, double{kWide} / kHigh);
    SceneBounds bounds;
    bounds.all = bounds.solid = {extent.center(), extent.radius()};
    const auto clip = make_clip_from_world(camera, double{kWide} / kHigh, bounds, 1.0);
    return *project(clip, p, kWide, kHigh);
  };
  const Vector3 c = extent.center(), x(0.1, 0, 0), y(0, 0.1, 0), z(0, 0, 0.1);
  CHECK(pixel_of("front", c + x).x() > pixel_of("front", c).x() + 1);
  CHECK(pixel_of("front", c + z).y() < pixel_of("front", c).y() - 1);
  CHECK(pixel_of("side", c + y).x() > pixel_of("side", c).x() + 1);
  CHECK(pixel_of("top", c + x).x() > pixel_of("top", c).x() + 1);
  CHECK(pixel_of("top", c + y).y() < pixel_of("top", c).y() - 1);
}

TEST_CASE("framing: one point, and none, give a finite camera") {
  Extent extent;
  const auto is_finite = [](const Camera& c) {
    return c.eye.allFinite() && c.target.allFinite() && (c.eye - c.target).norm() > 0;
  };
  CHECK(is_finite(make_camera({}, extent, 1.5)));
  extent.add(Vector3(1, 2, 3));
  extent.add(Vector3(NAN, 0, 0));  // left out
  CHECK(extent.points().size() == 1);
  CHECK(is_finite(make_camera({}, extent, 1.5)));
}

// Tables below, on, across and above z = 0.
TEST_CASE("framing: a floor that is not part of the scene intersects no body") {
  for (const double thickness : {0.001, 0.01, 0.03, 0.1, 1.0})
    for (const double middle : {-0.5 * thickness, 0.5 * thickness, 0.0, 3.0}) {
      CAPTURE(thickness);
      CAPTURE(middle);
      const SceneModel scene = built(
          "[[body]]\nname = \"table\"\nmass = 1\nshape = { cylinder = { radius = 1, length = " +
          std::to_string(thickness) + " } }\nposition = [0, 0, " + std::to_string(middle) + "]\n");
      SceneView stage = make_scene_view(scene);
      look_at(stage, snapshot_of(scene.model, scene.start));
      settle(stage);
      set_view(stage, {}, 1.5);
      CHECK(stage.list.ground.height <= middle - 0.5 * thickness + 1e-12);
      CHECK(stage.list.ground.height > middle - 0.5 * thickness - 4);
    }
}

TEST_CASE("framing: an unknown camera is rejected by name") {
  const Model<double> model = built(kBall).model;
  for (const char* name : {"frnt", "follow:bal", "1", "1,2,3,4", "1,95", "1,2,-3", "nan,0"}) {
    CAPTURE(name);
    const std::vector<Diagnostic> faults = faults_of([&] { parse_camera(name, model); });
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].where == "--camera");
    CHECK(faults[0].problem.find(name) != std::string::npos);
  }
  CHECK(parse_camera("follow:ball", model).follow == 1);
}

}  // namespace
}  // namespace twinarm
