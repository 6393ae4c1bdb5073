// Floor and background. The floor is drawn in tiles, without shadow lookup where no shadow can be
// (scene_pass.h); tiles are cut by the scissor, which leaves pixel values unchanged.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/render/gl/scene_pass.h"

namespace twinarm {
namespace {

constexpr int kTile = 64;  // [px], as in llvmpipe

using ShadowCorners = std::array<Eigen::Vector2d, 8>;

struct Interval {
  double low, high;
};

// Shadow of a box on the floor, in pixels. Empty if it may extend behind the eye, or for light from
// near or below the horizon.
std::optional<ShadowCorners> shadow_corners(const CasterBox& box, const FloorLight& light,
                                            const Eigen::Matrix4d& pixel_from_world) {
  if (!(light.towards_light_W.z() > 0.01)) return std::nullopt;
  const Vector3 along = light.towards_light_W / light.towards_light_W.z();
  const Vector3 half = box.half + Vector3::Constant(light.margin);
  ShadowCorners corners;
  for (unsigned i = 0; i < corners.size(); ++i) {  // bit k of i: the far side along axis k
    const Vector3 side(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    const Vector3 p = box.X_WB * half.cwiseProduct(side);
    const Vector3 on_floor = p - (p.z() - light.floor_height) * along;
    const Eigen::Vector4d pixel = pixel_from_world * on_floor.homogeneous();
    if (!(pixel.w() > 0) || !pixel.allFinite()) return std::nullopt;
    corners[i] = pixel.head<2>() / pixel.w();
  }
  return corners;
}

// x range of the convex hull in the strip low <= y <= high: its ends are corners, or intersections
// of the strip with lines between two corners. Empty: low > high.
Interval reach(const ShadowCorners& corners, double low, double high) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Interval x{kFar, -kFar};
  const auto add = [&](double value) {
    x.low = std::min(x.low, value);
    x.high = std::max(x.high, value);
  };
  for (const Eigen::Vector2d& a : corners) {
    for (const Eigen::Vector2d& b : corners) {  // upwards from a to b; a == b is a corner
      if (a.y() > b.y() || b.y() < low || a.y() > high) continue;
      const double rise = b.y() - a.y();
      const double from = a.y() < low ? (low - a.y()) / rise : 0;
      const double to = b.y() > high ? (high - a.y()) / rise : 1;
      add(a.x() + from * (b.x() - a.x()));
      add(a.x() + to * (b.x() - a.x()));
    }
  }
  return x;
}

// Marks the tiles of a row that intersect the interval, with a margin of one pixel.
void mark(std::vector<char>& row, const Interval& x) {
  const double count = static_cast<double>(row.size());
  const double first = std::floor((x.low - 1) / kTile), last = std::floor((x.high + 1) / kTile);
  if (!(first < count && last >= 0)) return;
  const auto at = [&](double tile) {
    return row.begin() + static_cast<std::ptrdiff_t>(std::clamp(tile, 0.0, count));
  };
  std::fill(at(first), at(last + 1), char{1});
}

}  // namespace

std::vector<FloorTiles> floor_tiles(const std::vector<CasterBox>& casters, const FloorLight& light,
                                    const Eigen::Matrix4d& clip_from_world, int width, int height) {
  Eigen::Matrix4d pixel_from_clip = Eigen::Matrix4d::Identity();
  pixel_from_clip.diagonal().head<2>() << 0.5 * width, 0.5 * height;
  pixel_from_clip.col(3).head<2>() << 0.5 * width, 0.5 * height;
  const Eigen::Matrix4d pixel_from_world = pixel_from_clip * clip_from_world;

  std::vector<ShadowCorners> shadows;
  for (const CasterBox& box : casters) {
    const std::optional<ShadowCorners> corners = shadow_corners(box, light, pixel_from_world);
    if (!corners) return {{0, 0, width, height, true}};
    shadows.push_back(*corners);
  }
  std::vector<FloorTiles> tiles;
  std::vector<char> row(static_cast<std::size_t>((width + kTile - 1) / kTile));
  for (int y = 0; y < height; y += kTile) {
    std::ranges::fill(row, char{0});
    for (const ShadowCorners& corners : shadows) mark(row, reach(corners, y - 1, y + kTile + 1));
    const int rows = std::min(kTile, height - y);
    for (std::size_t i = 0; i < row.size();) {
      const std::size_t begin = i;
      while (i < row.size() && row[i] == row[begin]) ++i;
      const int x = static_cast<int>(begin) * kTile, end = static_cast<int>(i) * kTile;
      tiles.push_back({x, y, std::min(end, width) - x, rows, row[begin] != 0});
    }
  }
  return tiles;
}

void ScenePass::set_floor(const Program& program, const LightSample& sample) const {
  const Ground& ground = list_->ground;
  const Vector3& center = list_->camera.target;
  set_frame(program, sample);
  set_backdrop(program);
  const auto set = [&](Uniform uniform, const Eigen::Vector4d& value) {
    program.set(uniform, Eigen::Vector4f(value.cast<float>()));
  };
  const double strong = ground.cell * ground.cells_per_major, fade = has_horizon() ? 0.5 : 1.0;
  set(Uniform::ground, {center.x(), center.y(), ground.height, floor_radius_});
  set(Uniform::grid, {ground.cell, strong, 0.008 * ground.cell, 0});
  set(Uniform::per_grid, {1 / ground.cell, 1 / strong, 1 / floor_radius_, 1 / fade});
}

void ScenePass::draw_floor(const LightSample& sample) const {
  // The margin is the filter radius of 2.5 texels and the normal offset.
  const double texel = 2.02 * bounds_.solid.radius / used_side(key_map_);
  const std::vector<FloorTiles> tiles =
      floor_tiles(casters_, {sample.key_W, list_->ground.height, 2.5 * texel + normal_offset()},
                  shifted_clip(sample), width_, height_);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.BindVertexArray(no_vertices_);
  for (const bool shadowed : {false, true}) {
    set_floor(shadowed ? backdrop().floor : backdrop().lit_floor, sample);
    for (const FloorTiles& part : tiles) {
      if (part.maybe_shadowed != shadowed) continue;
      gl_.Scissor(part.x, part.y, part.width, part.height);
      gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
  }
  gl_.Disable(GL_SCISSOR_TEST);
}

// Only above the rows that the floor fills.
void ScenePass::draw_background(const LightSample& sample) const {
  const int rows =
      list_->ground.visible
          ? rows_all_floor(clip_from_world_,
                           {list_->camera.target, list_->ground.height, floor_radius_}, height_)
          : 0;
  if (rows >= height_) return;
  const Program& background = backdrop().background;
  background.use();
  set_backdrop(background);
  background.set(Uniform::eye, Eigen::Vector3f(list_->camera.eye.cast<float>()));
  background.set(Uniform::world_from_clip,
                 Eigen::Matrix4f(shifted_clip(sample).inverse().cast<float>()));
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Scissor(0, rows, width_, height_ - rows);
  gl_.DepthMask(GL_FALSE);
  gl_.BindVertexArray(no_vertices_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.DepthMask(GL_TRUE);
  gl_.Disable(GL_SCISSOR_TEST);
}

}  // namespace twinarm
