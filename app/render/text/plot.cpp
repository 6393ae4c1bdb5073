#include "app/render/text/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/render/text/lettering.h"

namespace twinarm {
namespace {

using Eigen::Vector2d;

const Color kPlotInk{0.10f, 0.12f, 0.15f, 1.0f}, kPlotPaper{0.965f, 0.97f, 0.975f, 1.0f};
const Color kPlotGrid{0.80f, 0.82f, 0.84f, 1.0f}, kCursor{0.80f, 0.16f, 0.14f, 1.0f};

// Linear interpolation; empty outside, or beside a gap.
std::optional<double> value_at(const Plot& plot, const PlotCurve& curve, double t) {
  const auto next = std::ranges::upper_bound(plot.t, t);
  if (next == plot.t.begin()) return std::nullopt;
  const auto i = static_cast<std::size_t>(next - plot.t.begin()) - 1;
  if (i + 1 >= plot.t.size()) {
    if (t > plot.t.back() + 1e-9 || !std::isfinite(curve.y.back())) return std::nullopt;
    return curve.y.back();
  }
  const double share = (t - plot.t[i]) / (plot.t[i + 1] - plot.t[i]);
  const double y = curve.y[i] + share * (curve.y[i + 1] - curve.y[i]);
  if (!std::isfinite(y)) return std::nullopt;
  return y;
}

Image blank(int width, int height) {
  Image image = make_image(width, height);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const std::array<float, 4> c{kPlotPaper.r, kPlotPaper.g, kPlotPaper.b, 1};
    for (std::size_t k = 0; k < 4; ++k)
      image.rgba[i + k] = static_cast<std::uint8_t>(std::lround(255 * c[k]));
  }
  return image;
}

// Title and names of the curves, reduced to the width.
void draw_heading(Image& image, Lettering& letters, const Plot& plot, const Vector2d& low,
                  const Vector2d& high, double size) {
  const double gap = 1.2 * size, dash = 1.4 * size;
  double width = letters.width(plot.title, size, Weight::bold);
  for (const PlotCurve& curve : plot.curves)
    width += gap + dash + 0.4 * size + letters.width(curve.name, size);
  const double shrink = std::min(1.0, (high.x() - low.x()) / width);
  size *= shrink;
  Vector2d at(low.x(), low.y() - 0.6 * size);
  letters.draw(image, plot.title, at, size, kPlotInk, Weight::bold);
  at.x() += letters.width(plot.title, size, Weight::bold);
  for (const PlotCurve& curve : plot.curves) {
    at.x() += shrink * gap;
    const Vector2d middle(0, -0.35 * size);
    draw_line(image, at + middle, at + middle + Vector2d(shrink * dash, 0), 3, curve.color);
    at.x() += shrink * dash + 0.4 * size;
    letters.draw(image, curve.name, at, size, kPlotInk);
    at.x() += letters.width(curve.name, size);
  }
}

}  // namespace

PlotRange range_of(const std::vector<const Plot*>& plots) {
  PlotRange range;
  bool any = false;
  for (const Plot* plot : plots) {
    if (plot->t.empty()) continue;
    range.t_low = any ? std::min(range.t_low, plot->t.front()) : plot->t.front();
    range.t_high = any ? std::max(range.t_high, plot->t.back()) : plot->t.back();
    any = true;
    for (const PlotCurve& curve : plot->curves)
      for (const double y : curve.y)
        if (std::isfinite(y)) {
          range.y_low = std::min(range.y_low, y);
          range.y_high = std::max(range.y_high, y);
        }
  }
  if (!(range.t_high > range.t_low)) range.t_high = range.t_low + 1;
  const double span = range.y_high - range.y_low;
  if (!(span > 0)) {
    range.y_high = range.y_low + 1;
  } else {
    range.y_high += range.y_high > 0 ? 0.05 * span : 0;
    range.y_low -= range.y_low < 0 ? 0.05 * span : 0;
  }
  return range;
}

std::vector<double> round_ticks(double low, double high, int max_count) {
  std::vector<double> ticks;
  if (!(high > low) || !std::isfinite(high - low) || max_count < 1) return ticks;
  const double ten = std::pow(10.0, std::floor(std::log10((high - low) / max_count)));
  double step = ten;
  for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0}) {
    step = factor * ten;
    if (std::floor(high / step + 1e-9) - std::ceil(low / step - 1e-9) + 1 <= max_count) break;
  }
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    ticks.push_back(i == 0 ? 0.0 : i * step);
  return ticks;
}

Vector2d PlotStrip::Frame::pixel(double t, double y) const {
  const double right = (t - range.t_low) / (range.t_high - range.t_low);
  const double up = (y - range.y_low) / (range.y_high - range.y_low);
  return {low.x() + right * (high.x() - low.x()), high.y() - up * (high.y() - low.y())};
}

PlotStrip::PlotStrip(std::vector<Plot> plots, int width, int height)
    : plots_(std::move(plots)),
      size_px_(std::clamp(height / 11.0, 9.0, 30.0)),
      ground_(blank(width, height)) {
  Lettering letters;
  const double panel = static_cast<double>(width) / static_cast<double>(plots_.size());
  const double tick_px = 0.9 * size_px_;
  for (std::size_t p = 0; p < plots_.size(); ++p) {
    const double left = static_cast<double>(p) * panel;
    Frame frame{{left + 5 * size_px_, 1.9 * size_px_},
                {left + panel - 1.6 * size_px_, height - 1.9 * size_px_},
                plots_[p].range};
    const PlotRange& range = frame.range;
    for (const double y : round_ticks(range.y_low, range.y_high, 4)) {
      const Vector2d at = frame.pixel(range.t_low, y);
      draw_line(ground_, at, {frame.high.x(), at.y()}, 1, kPlotGrid);
      const std::string text = fmt::format("{:.4g}", y);
      letters.draw(ground_, text,
                   at + Vector2d(-0.5 * size_px_ - letters.width(text, tick_px), 0.35 * tick_px),
                   tick_px, kPlotInk);
    }
    for (const double t : round_ticks(range.t_low, range.t_high, 6)) {
      const Vector2d at = frame.pixel(t, range.y_low);
      draw_line(ground_, at, {at.x(), frame.low.y()}, 1, kPlotGrid);
      const std::string text = fmt::format("{:.4g} s", t);
      letters.draw(ground_, text, at + Vector2d(-0.5 * letters.width(text, tick_px), 1.3 * tick_px),
                   tick_px, kPlotInk);
    }
    for (const PlotCurve& curve : plots_[p].curves) {
      const auto point = [&](std::size_t i) { return frame.pixel(plots_[p].t[i], curve.y[i]); };
      for (std::size_t i = 0; i + 1 < plots_[p].t.size(); ++i)
        if (point(i).allFinite() && point(i + 1).allFinite())
          draw_line(ground_, point(i), point(i + 1), 2, curve.color);
    }
    draw_heading(ground_, letters, plots_[p], frame.low, frame.high, size_px_);
    frames_.push_back(frame);
  }
}

Image PlotStrip::at(double t) const {
  Image image = ground_;
  for (std::size_t p = 0; p < plots_.size(); ++p) {
    const Frame& frame = frames_[p];
    const double x = frame.pixel(std::clamp(t, frame.range.t_low, frame.range.t_high), 0).x();
    draw_line(image, {x, frame.low.y()}, {x, frame.high.y()}, 1.5, kCursor);
    for (const PlotCurve& curve : plots_[p].curves)
      if (const auto y = value_at(plots_[p], curve, t))
        draw_dot(image, frame.pixel(t, *y), 3.5, curve.color);
  }
  return image;
}

}  // namespace twinarm
