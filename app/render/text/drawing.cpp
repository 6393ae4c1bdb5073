// A shape is its signed distance: the share of a pixel that it covers follows from the distance of
// the pixel's middle to the edge.
#include "app/render/text/drawing.h"

#include <algorithm>
#include <cmath>

#include "app/render/text/lettering.h"

namespace twinarm {
namespace {

using Eigen::Vector2d;

// Share of the pixel under a shape of which the edge is `inside` pixels away.
float cover_at(double inside) {
  return static_cast<float>(std::clamp(inside + 0.5, 0.0, 1.0));
}

// Blends a shape given by its signed distance (inside positive) over the pixels of a box.
template <class Inside>
void fill(Image& image, const Vector2d& low, const Vector2d& high, const Color& color,
          Inside&& inside) {
  const int x0 = static_cast<int>(std::floor(std::max(0.0, low.x() - 1)));
  const int y0 = static_cast<int>(std::floor(std::max(0.0, low.y() - 1)));
  const int x1 = static_cast<int>(std::ceil(std::min<double>(image.width, high.x() + 1)));
  const int y1 = static_cast<int>(std::ceil(std::min<double>(image.height, high.y() + 1)));
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const float cover = cover_at(inside(Vector2d(x + 0.5, y + 0.5)));
      if (cover > 0) blend(image, x, y, color, cover);
    }
  }
}

}  // namespace

void draw_box(Image& image, const Vector2d& low, const Vector2d& high, double radius,
              const Color& color) {
  const Vector2d center = 0.5 * (low + high), half = 0.5 * (high - low);
  fill(image, low, high, color, [&](const Vector2d& p) {
    const Vector2d out = (p - center).cwiseAbs() - half + Vector2d::Constant(radius);
    return radius - out.cwiseMax(0).norm() - std::min(0.0, out.maxCoeff());
  });
}

void draw_line(Image& image, const Vector2d& a, const Vector2d& b, double width,
               const Color& color) {
  const Vector2d ab = b - a;
  const double squared = ab.squaredNorm();
  if (!(squared > 0)) return;
  const Vector2d margin = Vector2d::Constant(width);
  fill(image, a.cwiseMin(b) - margin, a.cwiseMax(b) + margin, color, [&](const Vector2d& p) {
    const double t = std::clamp((p - a).dot(ab) / squared, 0.0, 1.0);
    return 0.5 * width - (p - a - t * ab).norm();
  });
}

void draw_dot(Image& image, const Vector2d& center, double radius, const Color& color) {
  const Vector2d reach = Vector2d::Constant(radius);
  fill(image, center - reach, center + reach, color,
       [&](const Vector2d& p) { return radius - (p - center).norm(); });
}

}  // namespace twinarm
