// ShadowCorners, hulls, rows of tiles.
#include "app/render/gl/shadow_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace twinarm {
namespace {

constexpr int kTile = 64;  // [px]; those of llvmpipe: cut smaller, each costs more than it saves

using ShadowCorners = std::array<Eigen::Vector2d, 8>;

struct Interval {
  double low, high;
};

// The shadow of a box on the floor, in pixels. Nothing where it may reach behind the eye, or where
// the light comes from so low that shadows have no end.
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

// What the hull covers of the strip low <= y <= high: it ends at a corner, or where an edge leaves
// the strip, and every edge joins two corners. Empty: low > high.
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

// Marks the tiles of a row that the interval meets, with a pixel to spare.
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

}  // namespace twinarm
