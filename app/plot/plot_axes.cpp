#include "app/plot/plot_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace twinarm::compare_page {

std::string tics(const char* axis, double low, double high, int about) {
  const double wish = (high - low) / about;
  if (!(wish > 0) || !std::isfinite(wish)) return "";
  const double power = std::pow(10, std::floor(std::log10(wish)));
  double step = 10 * power;
  for (const double digit : {5, 2, 1})
    if (digit * power >= wish) step = digit * power;
  return fmt::format("set {}tics {:.9g}\n", axis, step);
}

std::string range_of(const std::vector<const std::vector<double>*>& all) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const auto* values : all)
    for (const double x : *values)
      if (std::isfinite(x)) low = std::min(low, x), high = std::max(high, x);
  if (low > high) return "";
  const double size = std::max(std::abs(low), std::abs(high));
  double margin = 0.08 * (high - low);
  if (high - low <= 1e-6 * size || size == 0) margin = size > 0 ? 0.5 * size : 1;
  low -= margin, high += margin;
  return fmt::format("set yrange [{:.9g}:{:.9g}]\n", low, high) + tics("y", low, high, 5);
}

std::string log_axis(const char* axis, double low, double high) {
  constexpr double kShort = 30;
  low /= 1.6, high *= 1.6;
  std::string script = fmt::format("set {}range [{:g}:{:g}]\n", axis, low, high);
  if (high / low > kShort) return script + fmt::format("set format {} '10^{{%T}}'\n", axis);
  std::string marks;
  const int first = static_cast<int>(std::floor(std::log10(low)));
  for (int power = first; std::pow(10, power) < high; ++power)
    for (const int digit : {1, 2, 5}) {
      const double at = digit * std::pow(10, power);
      if (at < low || at > high) continue;
      const std::string name =
          digit == 1 ? fmt::format("10^{{{}}}", power) : fmt::format("{}·10^{{{}}}", digit, power);
      marks += fmt::format("{}'{}' {:.9g}", marks.empty() ? "" : ", ", name, at);
    }
  return script + fmt::format("set {}tics ({})\n", axis, marks);
}

}  // namespace twinarm::compare_page
