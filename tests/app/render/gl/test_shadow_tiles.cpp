// Tiles with shadow lookup, against single light rays.
#include "app/render/gl/scene_pass.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "app/render/list/view.h"

namespace twinarm {
namespace {

constexpr int kPictureWidth = 300, kPictureHeight = 200;  // not whole tiles

// Random numbers in -1..1, vectors and poses.
class BoxDice {
 public:
  explicit BoxDice(unsigned seed) : generator_(seed) {}
  double operator()() { return number_(generator_); }
  Vector3 vector() { return {(*this)(), (*this)(), (*this)()}; }
  CasterBox box() {
    CasterBox box;
    box.X_WB.R = Eigen::Quaterniond((*this)(), (*this)(), (*this)(), 1.5).normalized().matrix();
    box.X_WB.p = 2 * vector() + Vector3(0, 0, 2.5);
    box.half = 0.3 * (vector().cwiseAbs() + Vector3::Constant(0.1));
    return box;
  }

 private:
  std::mt19937 generator_;
  std::uniform_real_distribution<double> number_{-1, 1};
};

struct LitBoxes {
  std::vector<CasterBox> boxes;
  FloorLight light;
  Eigen::Matrix4d clip_from_world;

  std::vector<FloorTiles> tiles() const {
    return floor_tiles(boxes, light, clip_from_world, kPictureWidth, kPictureHeight);
  }
};

LitBoxes random_boxes(BoxDice& dice, int box_count) {
  LitBoxes scene;
  for (int i = 0; i < box_count; ++i) scene.boxes.push_back(dice.box());
  scene.light = {(dice.vector() + Vector3(0, 0, 2)).normalized(), 0.2 * dice(), 0.4};
  Camera camera;
  camera.eye = 3 * dice.vector() + Vector3(0, 0, 9);
  scene.clip_from_world = make_clip_from_world(
      camera, static_cast<double>(kPictureWidth) / kPictureHeight, {{}, {{}, 5}}, 20);
  return scene;
}

// Number of tiles with the centre of this pixel, from the lower left corner.
int parts_at(const std::vector<FloorTiles>& tiles, int x, int y, bool only_shadowed) {
  int count = 0;
  for (const FloorTiles& part : tiles) {
    const bool inside =
        x >= part.x && x < part.x + part.width && y >= part.y && y < part.y + part.height;
    if (inside && (part.maybe_shadowed || !only_shadowed)) ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("shadow tiles: each pixel is in one tile") {
  BoxDice dice(1);
  for (int run = 0; run < 20; ++run) {
    const std::vector<FloorTiles> tiles = random_boxes(dice, run % 4).tiles();
    int wrong = 0;
    for (int y = 0; y < kPictureHeight; ++y)
      for (int x = 0; x < kPictureWidth; ++x) wrong += parts_at(tiles, x, y, false) != 1;
    CHECK(wrong == 0);
  }
}

TEST_CASE("shadow tiles: every shadow on the floor is in a tile with shadow lookup") {
  BoxDice dice(2);
  int seen = 0, lit = 0;
  for (int run = 0; run < 200; ++run) {
    const LitBoxes scene = random_boxes(dice, 1 + run % 3);
    const std::vector<FloorTiles> tiles = scene.tiles();
    for (const FloorTiles& part : tiles) lit += !part.maybe_shadowed;
    for (int i = 0; i < 200; ++i) {
      // A point of a body or within the margin of one.
      const CasterBox& box = scene.boxes[static_cast<std::size_t>(i) % scene.boxes.size()];
      const Vector3 beside = scene.light.margin * dice.vector().normalized();
      const Vector3 p = box.X_WB * box.half.cwiseProduct(dice.vector()) + beside;
      const Vector3& l = scene.light.towards_light_W;
      const Vector3 end = p - (p.z() - scene.light.floor_height) / l.z() * l;
      const auto pixel = project(scene.clip_from_world, end, kPictureWidth, kPictureHeight);
      if (!pixel) continue;
      const int x = static_cast<int>(std::floor(pixel->x()));
      const int y = kPictureHeight - 1 - static_cast<int>(std::floor(pixel->y()));
      if (x < 0 || x >= kPictureWidth || y < 0 || y >= kPictureHeight) continue;
      ++seen;
      CHECK(parts_at(tiles, x, y, true) == 1);
    }
  }
  CHECK(seen > 5000);  // enough shadowed points,
  CHECK(lit > 500);    // and lit tiles
}

TEST_CASE("shadow tiles: horizontal light looks up shadows everywhere") {
  BoxDice dice(3);
  for (const double height : {-0.5, 0.0, 1e-3}) {
    LitBoxes scene = random_boxes(dice, 1);
    scene.light.towards_light_W = Vector3(1, 0, height).normalized();
    const std::vector<FloorTiles> tiles = scene.tiles();
    REQUIRE(tiles.size() == 1);
    CHECK(tiles[0].maybe_shadowed);
  }
}

TEST_CASE("shadow tiles: a shadow that extends behind the eye is looked up everywhere") {
  BoxDice dice(4);
  LitBoxes scene = random_boxes(dice, 1);
  scene.boxes[0].half = Vector3(1000, 1000, 0.1);
  Camera camera;  // low, looking along the floor
  camera.eye = Vector3(0, -3, 0.5);
  scene.clip_from_world = make_clip_from_world(camera, 1.5, {{}, {{}, 5}}, 20);
  const std::vector<FloorTiles> tiles = scene.tiles();
  REQUIRE(tiles.size() == 1);
  CHECK(tiles[0].maybe_shadowed);
}

}  // namespace twinarm
