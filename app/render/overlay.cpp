// Layout in pixels from the top left, y down.
#include "app/render/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/render/view.h"

namespace twinarm {
namespace {

using Eigen::Vector2d;

const Color kInk{0.10f, 0.12f, 0.15f, 1.0f};
const Color kPaper{0.97f, 0.98f, 0.99f, 0.62f};

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

void draw_rounded_box(Image& image, const Vector2d& low, const Vector2d& high, double radius,
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

// Where a label's text stands: the left end of its base line, and its width.
struct Placed {
  Vector2d start_px;
  double width;
};

// Text that would leave the picture, or run into the title above `top_px`, is moved back.
Placed place(const Image& image, Lettering& lettering, const Label& label, double top_px,
             Vector2d at_px) {
  constexpr double kMargin = 6;  // [px]
  const double width = lettering.width(label.text, label.size_px);
  if (label.align != Align::left) at_px.x() -= label.align == Align::center ? 0.5 * width : width;
  const Vector2d low(kMargin, top_px + kMargin + label.size_px);
  const Vector2d high(image.width - kMargin - width, image.height - kMargin - 0.3 * label.size_px);
  return {at_px.cwiseMin(high).cwiseMax(low), width};
}

bool is_inside(const Image& image, const Vector2d& p) {
  return p.x() >= 0 && p.y() >= 0 && p.x() <= image.width && p.y() <= image.height;
}

void draw_screen_label(Image& image, Lettering& lettering, const Label& label, double top_px) {
  Vector2d at_px = label.offset_px;
  if (at_px.x() < 0) at_px.x() += image.width;
  if (at_px.y() < 0) at_px.y() += image.height;
  const Placed text = place(image, lettering, label, top_px, at_px);
  lettering.draw(image, label.text, text.start_px, label.size_px, label.color);
}

// A thin line from the point to the nearest place beside the text, and a dot on the point.
void draw_leader(Image& image, const Label& label, const Placed& text, const Vector2d& anchor_px) {
  constexpr double kShortest = 12, kGap = 5;                       // [px]
  const double middle = text.start_px.y() - 0.35 * label.size_px;  // of the letters' height
  const Vector2d end_px(
      std::clamp(anchor_px.x(), text.start_px.x() - kGap, text.start_px.x() + text.width + kGap),
      std::clamp(anchor_px.y(), middle - 0.5 * label.size_px - kGap,
                 middle + 0.5 * label.size_px + kGap));
  if ((end_px - anchor_px).norm() < kShortest) return;
  Color line = label.color;
  line.a *= 0.85f;
  draw_line(image, anchor_px, end_px, 3, kPaper);
  draw_line(image, anchor_px, end_px, 1.2, line);
  fill(image, anchor_px - Vector2d(3, 3), anchor_px + Vector2d(3, 3), line,
       [&](const Vector2d& p) { return 2.4 - (p - anchor_px).norm(); });
}

void draw_world_label(Image& image, Lettering& lettering, const Label& label, double top_px,
                      const Vector2d& anchor_px) {
  const Placed text = place(image, lettering, label, top_px, anchor_px + label.offset_px);
  draw_leader(image, label, text, anchor_px);
  lettering.draw(image, label.text, text.start_px, label.size_px, label.color);
}

// At the bottom left, on a pale panel; sized with the picture.
void draw_legend(Image& image, const DrawList& list, Lettering& lettering, double size_px) {
  if (list.legend.empty()) return;
  const double row = 1.6 * size_px, margin = 1.4 * size_px, padding = 0.75 * size_px;
  const double swatch = 0.85 * size_px, text_x = swatch + 0.7 * size_px;
  double width = 0;
  for (const LegendLine& line : list.legend) {
    width = std::max(width, text_x + lettering.width(line.text, size_px));
  }
  const double height = row * static_cast<double>(list.legend.size());
  const Vector2d low(margin, image.height - margin - height - 2 * padding);
  draw_rounded_box(image, low, low + Vector2d(width + 2 * padding, height + 2 * padding),
                   0.5 * size_px, kPaper);
  Vector2d at = low + Vector2d(padding, padding + 0.5 * row);  // left end, middle of the row
  for (const LegendLine& line : list.legend) {
    const Vector2d top = at - Vector2d(0, 0.5 * swatch);
    draw_rounded_box(image, top, top + Vector2d(swatch, swatch), 0.22 * swatch, line.color);
    lettering.draw(image, line.text, at + Vector2d(text_x, 0.36 * size_px), size_px, kInk);
    at.y() += row;
  }
}

// At the bottom right: what the lines on the floor measure.
void draw_grid_scale(Image& image, const Ground& ground, Lettering& lettering, double size_px) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "grid %g m, bold %g m", ground.cell,
                ground.cell * ground.cells_per_major);
  const double width = lettering.width(text.data(), size_px);
  lettering.draw(image, text.data(),
                 {image.width - 1.4 * size_px - width, image.height - 1.4 * size_px}, size_px,
                 kInk);
}

// At the top left, smaller where it would be too wide. Returns where it ends below.
double draw_title(Image& image, const std::string& title, Lettering& lettering, double size_px) {
  if (title.empty()) return 0;
  const double margin = 1.4 * size_px, room = image.width - 2 * margin;
  double title_px = 1.7 * size_px;
  title_px *= std::min(1.0, room / lettering.width(title, title_px, Weight::bold));
  lettering.draw(image, title, {margin, margin + 0.75 * title_px}, title_px, kInk, Weight::bold);
  return margin + title_px;
}

}  // namespace

void draw_overlay(Image& image, const DrawList& list, const Eigen::Matrix4d& clip_from_world,
                  Lettering& lettering) {
  const double size_px = std::clamp(image.height / 50.0, 10.0, 40.0);
  const double top_px = draw_title(image, list.title, lettering, size_px);
  for (const Label& label : list.labels) {
    if (label.anchor == Label::Anchor::screen) {
      draw_screen_label(image, lettering, label, top_px);
      continue;
    }
    const auto anchor_px = project(clip_from_world, label.p_W, image.width, image.height);
    if (anchor_px && is_inside(image, *anchor_px)) {
      draw_world_label(image, lettering, label, top_px, *anchor_px);
    }
  }
  draw_legend(image, list, lettering, size_px);
  if (list.ground.visible && list.ground.show_scale) {
    draw_grid_scale(image, list.ground, lettering, 0.9 * size_px);
  }
}

}  // namespace twinarm
