// Invalid and extreme input of the painter.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "app/render/gl/painter.h"
#include "app/render/list/view.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

struct PixelSize {
  int width, height;
};

DrawList one_box() {
  DrawList list;
  add_box(list, {}, {1, 1, 1}, {1, 0, 0, 1});
  return list;
}

}  // namespace

TEST_CASE("painter: sizes of zero or too many pixels are rejected") {
  for (const PixelSize& size : {PixelSize{0, 10}, {10, 0}, {-1, 10}, {10, 1 << 20}}) {
    CAPTURE(size.width);
    CAPTURE(size.height);
    CHECK_THROWS_AS(Painter(Backend::osmesa, size.width, size.height), InputError);
  }
}

TEST_CASE("painter: pictures of odd size are complete and opaque") {
  for (const Quality quality : {Quality::draft, Quality::normal})
    for (const PixelSize& size : {PixelSize{1, 1}, {1, 7}, {3, 1}, {17, 33}, {333, 5}}) {
      const Image image =
          Painter(Backend::osmesa, size.width, size.height, quality).paint(one_box());
      REQUIRE(image.width == size.width);
      REQUIRE(image.height == size.height);
      for (std::size_t i = 3; i < image.rgba.size(); i += 4) REQUIRE(image.rgba[i] == 255);
    }
}

TEST_CASE("painter: instances that are not finite are left out") {
  DrawList list = one_box();
  const Image without = Painter(Backend::osmesa, 64, 48).paint(list);
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), inf, 1e300}) {
    add_box(list, {Matrix3::Identity(), Vector3(bad, 0, 0)}, {1, 1, 1}, {0, 1, 0, 1});
    add_sphere(list, Vector3(0, 0, 0), bad, {0, 1, 0, 1});
    add_arrow(list, Vector3::Zero(), Vector3(0, bad, 0), 0.1, {0, 1, 0, 1});
    list.instances.push_back(list.instances.front());
    list.instances.back().X_WM.R(1, 2) = bad;
  }
  CHECK(Painter(Backend::osmesa, 64, 48).paint(list).rgba == without.rgba);
}

TEST_CASE("painter: an invalid camera is rejected with the reason") {
  Painter painter(Backend::osmesa, 16, 16, Quality::draft);
  const auto is_refused = [&](auto change) {
    DrawList list = one_box();
    change(list.camera);
    CHECK_THROWS_AS(painter.paint(list), InputError);
  };
  is_refused([](Camera& c) { c.eye.x() = std::nan(""); });
  is_refused([](Camera& c) { c.target.z() = std::nan(""); });
  is_refused([](Camera& c) { c.eye = c.target; });
  is_refused([](Camera& c) { c.field_of_view = 0; });
  is_refused([](Camera& c) { c.field_of_view = 3.2; });
}

// Intersection of the line of sight with the floor, by the camera's geometry instead of its matrix.
TEST_CASE("view: rows_all_floor() counts the rows that the floor fills") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-1, 1);
  constexpr int kHeight = 90;
  constexpr double kAspect = 16.0 / 9;
  int some = 0, all = 0;
  for (int i = 0; i < 300; ++i) {
    Camera camera;
    camera.eye = Vector3(2 * at(random), 2 * at(random), 0.3 + std::abs(at(random)));
    camera.target = Vector3(0.3 * at(random), 0.3 * at(random), 0.5 * at(random));
    const double radius = 2 + 4 * std::abs(at(random)), height = -0.2;
    SceneBounds bounds;
    bounds.all = bounds.solid = {camera.target, 0.5};
    const int rows = rows_all_floor(make_clip_from_world(camera, kAspect, bounds, radius),
                                    {camera.target, height, radius}, kHeight);
    const Vector3 forward = (camera.target - camera.eye).normalized();
    const Vector3 right = forward.cross(camera.up).normalized(), up = right.cross(forward);
    const double half = std::tan(0.5 * camera.field_of_view);
    const auto is_floor = [&](double x, double y) {
      const Vector3 line = forward + half * (kAspect * x * right + y * up);
      const double far = (height - camera.eye.z()) / line.z();
      const Vector3 off = camera.eye + far * line - camera.target;
      return far > 0 && off.head<2>().cwiseAbs().maxCoeff() < radius;
    };
    const auto row_is_floor = [&](double row) {
      bool is = true;
      for (double x = -1; x <= 1; x += 0.125) is = is && is_floor(x, 2 * row / kHeight - 1);
      return is;
    };
    for (int row = 0; row <= rows; ++row)
      if (rows > 0) CHECK(row_is_floor(row));
    if (rows < kHeight) CHECK((rows == 0 || !row_is_floor(rows + 8)));
    some += rows > 0 && rows < kHeight;
    all += rows == kHeight;
  }
  CHECK(some > 20);
  CHECK(all > 20);
}

}  // namespace twinarm
