#include "app/render/text/lettering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "app/render/list/view.h"

namespace twinarm {
namespace {

using Eigen::Vector2d;

const Color kInk{0.10f, 0.12f, 0.15f, 1.0f};
const Color kPaper{0.97f, 0.98f, 0.99f, 0.62f};

constexpr double kUsualLetters = 14.4;  // height of the legend's at 1280 x 720 [px]

Label scaled(Label label, double scale) {
  label.offset_px *= scale;
  label.size_px *= scale;
  return label;
}

ScreenBox scaled(ScreenBox bar, double scale) {
  bar.corner_px *= scale;
  bar.size_px *= scale;
  return bar;
}

// Left end of a text's base line, and its width.
struct Placed {
  Vector2d start_px;
  double width;
};

// Moved into the picture, below the title that ends at `top_px`.
Placed place(const Image& image, Lettering& lettering, const Label& label, double top_px,
             const Vector2d& at_px) {
  constexpr double kMargin = 6;  // [px]
  const double width = lettering.width(label.text, label.size_px);
  const Vector2d low(kMargin, top_px + kMargin + label.size_px);
  const Vector2d high(image.width - kMargin - width, image.height - kMargin - 0.3 * label.size_px);
  return {at_px.cwiseMin(high).cwiseMax(low), width};
}

struct Rectangle {
  Vector2d low, high;
};
using Occupied = std::vector<Rectangle>;  // by text and panels

Rectangle rectangle_of(const Placed& text, double size_px) {
  return {text.start_px - Vector2d(4, 0.9 * size_px),
          text.start_px + Vector2d(text.width + 4, 0.25 * size_px)};
}

bool is_free(const Occupied& occupied, const Rectangle& r) {
  return std::ranges::none_of(occupied, [&](const Rectangle& other) {
    return (r.low.array() < other.high.array()).all() && (r.high.array() > other.low.array()).all();
  });
}

// Lines to try: the previous one, the preferred one, the nearest above and below.
std::vector<double> lines_to_try(double before) {
  std::vector<double> lines{before, 0};
  for (int n = 1; n <= 4; ++n) {
    lines.push_back(-n);
    lines.push_back(n);
  }
  return lines;
}

// At its preferred position or on the nearest free line; empty if there is none.
std::optional<Placed> place_free(const Image& image, Lettering& lettering, const Label& label,
                                 double top_px, const Vector2d& anchor_px, Occupied& occupied,
                                 LabelMemory* memory) {
  constexpr double kGlide = 0.3;  // share of the distance in each picture
  const double line_px = 1.25 * label.size_px;
  const auto placed_at = [&](double down_px) {
    return place(image, lettering, label, top_px,
                 anchor_px + label.offset_px + Vector2d(0, down_px));
  };
  LabelMemory::Place* before = memory ? memory->find_or_add(label.text) : nullptr;
  const bool is_new = !before || memory->is_new(*before);
  for (const double line : lines_to_try(is_new ? 0 : before->line)) {
    const Placed found = placed_at(line * line_px);
    const Rectangle rectangle = rectangle_of(found, label.size_px);
    if (!is_free(occupied, rectangle)) continue;
    occupied.push_back(rectangle);
    if (!before) return found;
    before->line = line;
    before->picture = memory->picture();
    before->shift_px += (is_new ? 1 : kGlide) * (line * line_px - before->shift_px);
    return placed_at(before->shift_px);
  }
  return std::nullopt;
}

bool is_inside(const Image& image, const Vector2d& p) {
  return p.x() >= 0 && p.y() >= 0 && p.x() <= image.width && p.y() <= image.height;
}

// From the bottom or right if negative.
Vector2d on_screen(const Image& image, Vector2d offset_px) {
  if (offset_px.x() < 0) offset_px.x() += image.width;
  if (offset_px.y() < 0) offset_px.y() += image.height;
  return offset_px;
}

void draw_bar(Image& image, const ScreenBox& bar, Occupied& occupied) {
  if (!bar.corner_px.allFinite() || !bar.size_px.allFinite()) return;
  if (!(bar.size_px.minCoeff() > 0)) return;
  const Vector2d low = on_screen(image, bar.corner_px);
  draw_box(image, low, low + bar.size_px, std::min(3.0, 0.5 * bar.size_px.minCoeff()), bar.color);
  occupied.push_back({low, low + bar.size_px});
}

void draw_screen_label(Image& image, Lettering& lettering, const Label& label, double top_px,
                       Occupied& occupied) {
  const Vector2d at_px = on_screen(image, label.offset_px);
  const Placed text = place(image, lettering, label, top_px, at_px);
  occupied.push_back(rectangle_of(text, label.size_px));
  lettering.draw(image, label.text, text.start_px, label.size_px, label.color);
}

// A thin line from the point to the text, and a dot on the point.
void draw_leader(Image& image, const Label& label, const Placed& text, const Vector2d& anchor_px) {
  constexpr double kMinLength = 12, kGap = 5;                      // [px]
  const double middle = text.start_px.y() - 0.35 * label.size_px;  // of the letters' height
  const Vector2d end_px(
      std::clamp(anchor_px.x(), text.start_px.x() - kGap, text.start_px.x() + text.width + kGap),
      std::clamp(anchor_px.y(), middle - 0.5 * label.size_px - kGap,
                 middle + 0.5 * label.size_px + kGap));
  if ((end_px - anchor_px).norm() < kMinLength) return;
  Color line = label.color;
  line.a *= 0.85f;
  draw_line(image, anchor_px, end_px, 3, kPaper);
  draw_line(image, anchor_px, end_px, 1.2, line);
  draw_dot(image, anchor_px, 2.4, line);
}

void draw_world_label(Image& image, Lettering& lettering, const Label& label, double top_px,
                      const Vector2d& anchor_px, Occupied& occupied, LabelMemory* memory) {
  const auto text = place_free(image, lettering, label, top_px, anchor_px, occupied, memory);
  if (!text) return;
  draw_leader(image, label, *text, anchor_px);
  lettering.draw(image, label.text, text->start_px, label.size_px, label.color);
}

// At the bottom left, on a panel.
void draw_legend(Image& image, const DrawList& list, Lettering& lettering, double size_px,
                 Occupied& occupied) {
  if (list.legend.empty()) return;
  const double row = 1.6 * size_px, margin = 1.4 * size_px, padding = 0.75 * size_px;
  const double swatch = 0.85 * size_px, text_x = swatch + 0.7 * size_px;
  double width = 0;
  for (const LegendLine& line : list.legend)
    width = std::max(width, text_x + lettering.width(line.words(), size_px));
  const double height = row * static_cast<double>(list.legend.size());
  const Vector2d low(margin, image.height - margin - height - 2 * padding);
  const Vector2d high = low + Vector2d(width + 2 * padding, height + 2 * padding);
  draw_box(image, low, high, 0.5 * size_px, kPaper);
  occupied.push_back({low, high});
  Vector2d at = low + Vector2d(padding, padding + 0.5 * row);  // left end, middle of the row
  for (const LegendLine& line : list.legend) {
    const Vector2d top = at - Vector2d(0, 0.5 * swatch);
    draw_box(image, top, top + Vector2d(swatch, swatch), 0.22 * swatch, line.color);
    const double part = swatch / static_cast<double>(std::max<std::size_t>(1, line.bar.size()));
    for (std::size_t k = 0; k < line.bar.size(); ++k) {
      const Vector2d corner = top + Vector2d(part * static_cast<double>(k), 0);
      draw_box(image, corner, corner + Vector2d(part, swatch), 0, line.bar[k]);
    }
    lettering.draw(image, line.words(), at + Vector2d(text_x, 0.36 * size_px), size_px, kInk);
    at.y() += row;
  }
}

// At the bottom right.
void draw_grid_scale(Image& image, const Ground& ground, Lettering& lettering, double size_px) {
  const std::string text =
      fmt::format("grid {:g} m, bold {:g} m", ground.cell, ground.cell * ground.cells_per_major);
  const double right = image.width - 1.4 * size_px - lettering.width(text, size_px);
  lettering.draw(image, text, {right, image.height - 1.4 * size_px}, size_px, kInk);
}

// At the top left, reduced to the picture's width. Returns its lower end.
double draw_title(Image& image, const std::string& title, Lettering& lettering, double size_px) {
  if (title.empty()) return 0;
  const double margin = 1.4 * size_px, room = image.width - 2 * margin;
  double title_px = 1.7 * size_px;
  title_px *= std::min(1.0, room / lettering.width(title, title_px, Weight::bold));
  lettering.draw(image, title, {margin, margin + 0.75 * title_px}, title_px, kInk, Weight::bold);
  return margin + title_px;
}

}  // namespace

LabelMemory::Place* LabelMemory::find_or_add(const std::string& words) {
  std::string name = words;
  std::erase_if(name, [](char c) { return std::strchr("0123456789.-+kMm", c) != nullptr; });
  name += '#' + std::to_string(seen_[name]++);
  return &places_[name];
}

void draw_overlay(Image& image, const DrawList& list, const Eigen::Matrix4d& clip_from_world,
                  Lettering& lettering, LabelMemory* memory) {
  if (memory) memory->begin();
  const double size_px = std::clamp(std::max(image.height / 50.0, image.width / 92.0), 10.0, 40.0);
  const double scale = size_px / kUsualLetters;
  const double top_px = draw_title(image, list.title, lettering, size_px);
  Occupied occupied;
  draw_legend(image, list, lettering, size_px, occupied);
  for (const ScreenBox& bar : list.bars) draw_bar(image, scaled(bar, scale), occupied);
  for (const Label& label : list.labels)
    if (label.anchor == Label::Anchor::screen)
      draw_screen_label(image, lettering, scaled(label, scale), top_px, occupied);
  for (const Label& unscaled : list.labels) {
    const Label label = scaled(unscaled, scale);
    if (label.anchor == Label::Anchor::screen) continue;
    const auto anchor_px = project(clip_from_world, label.p_W, image.width, image.height);
    if (anchor_px && is_inside(image, *anchor_px))
      draw_world_label(image, lettering, label, top_px, *anchor_px, occupied, memory);
  }
  if (list.ground.visible) draw_grid_scale(image, list.ground, lettering, 0.9 * size_px);
}

}  // namespace twinarm
