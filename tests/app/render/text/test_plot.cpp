// Plots below pictures: ticks, ranges, pixels of the curve.
#include "app/render/text/plot.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace twinarm {
namespace {

TEST_CASE("plot: ticks are round, evenly spaced, inside the range, and at most as many as given") {
  for (const double low : {-7.3, 0.0, 0.013, 1e5})
    for (const double span : {1e-9, 0.37, 3.0, 10.0, 99.0, 4.2e7})
      for (const int most : {1, 3, 6}) {
        CAPTURE(low);
        CAPTURE(span);
        const auto ticks = round_ticks(low, low + span, most);
        REQUIRE(ticks.size() <= static_cast<std::size_t>(most));
        for (const double tick : ticks) {
          CHECK(tick >= low - 1e-6 * span);
          CHECK(tick <= low + span + 1e-6 * span);
        }
        if (ticks.size() < 2) continue;
        const double step = ticks[1] - ticks[0];
        const double lead = step / std::pow(10, std::floor(std::log10(step * 1.0001)));
        const bool is_round =
            std::abs(lead - 1) < 1e-3 || std::abs(lead - 2) < 1e-3 || std::abs(lead - 5) < 1e-3;
        if (span > 1e-6 * std::abs(low)) CHECK(is_round);
      }
  CHECK(round_ticks(0, 1, 6) == std::vector<double>{0, 0.2, 0.4, 0.6000000000000001, 0.8, 1});
  CHECK(round_ticks(0, std::numeric_limits<double>::infinity(), 4).empty());
  CHECK(round_ticks(1, 1, 4).empty());
}

TEST_CASE("plot: a common range contains 0 and two plots, without values that are not finite") {
  Plot a, b;
  a.t = {0, 1};
  a.curves = {{"x", {}, {3, -1}}};
  b.t = {0.5, 2};
  b.curves = {{"y", {}, {NAN, 7}}, {"z", {}, {INFINITY, 2}}};
  const PlotRange range = range_of({&a, &b});
  CHECK(range.t_low == 0);
  CHECK(range.t_high == 2);
  CHECK(range.y_high == doctest::Approx(7 + 0.05 * 8));
  CHECK(range.y_low == doctest::Approx(-1 - 0.05 * 8));
  const Plot nothing;
  CHECK(range_of({&nothing}).t_high > range_of({&nothing}).t_low);
  CHECK(range_of({&nothing}).y_high > 0);
}

// Mean height of the pixels of one colour in a column, from the bottom; negative: none.
double height_of(const Image& image, int x, const Color& color) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* p = image.pixel(x, y);
    const auto off = [&](int c, float wanted) { return std::abs(p[c] / 255.0 - wanted) > 0.02; };
    if (off(0, color.r) || off(1, color.g) || off(2, color.b)) continue;
    sum += image.height - y;
    ++count;
  }
  return count > 0 ? sum / count : -1;
}

TEST_CASE("plot: a linear curve is a straight line of pixels and ends at a gap") {
  const Color magenta{1, 0, 1, 1};
  Plot plot;
  plot.title = "a [m]";
  for (int i = 0; i <= 100; ++i) plot.t.push_back(0.01 * i);
  plot.curves = {{"line", magenta, {}}};
  for (int i = 0; i <= 100; ++i)
    plot.curves[0].y.push_back(i <= 80 ? 0.02 * i : std::numeric_limits<double>::quiet_NaN());
  plot.range = {0, 1, 0, 2};
  const Image image = PlotStrip({plot}, 640, 200).at(0.1);
  std::vector<double> heights;
  for (int x = 200; x <= 400; x += 50) heights.push_back(height_of(image, x, magenta));
  for (std::size_t i = 2; i < heights.size(); ++i) {
    CHECK(heights[i] > heights[i - 1] + 5);
    CHECK(std::abs(heights[i] - 2 * heights[i - 1] + heights[i - 2]) < 1.5);
  }
  CHECK(height_of(image, 590, magenta) < 0);  // t = 0.9
}

}  // namespace
}  // namespace twinarm
