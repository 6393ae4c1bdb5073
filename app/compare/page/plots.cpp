#include "app/compare/page/page.h"
#include "app/support/text.h"

#include <cctype>

namespace twinarm::compare_page {
namespace {

constexpr std::size_t kStretches = 80;  // few points: a page has hundreds of curves
constexpr std::size_t kMaxPanels = 4;

struct LineStyle {
  const char* colour;
  const char* dash;
};
// Alternately dark and light, to differ in greyscale as well.
constexpr LineStyle kLines[] = {{"#3F6FB5", "solid"},       {palette::dvr, "solid"},
                                {palette::linear, "solid"}, {palette::torsional, "solid"},
                                {palette::faint, "solid"},  {"#C58AD0", "(6,4)"},
                                {"#8DB0DD", "(6,4)"},       {palette::ink, "(6,4)"}};

// A colour for each order, a point type for each scheme.
struct SchemeStyle {
  Integrator integrator;
  const char* colour;
  int point;
};
constexpr SchemeStyle kSchemes[] = {
    {Integrator::euler, palette::dvr, 6},
    {Integrator::semi_implicit, palette::dvr, 7},
    {Integrator::semi_implicit_xv, palette::dvr, 5},
    {Integrator::implicit_euler, palette::dvr, 4},
    {Integrator::verlet, "#3F6FB5", 7},
    {Integrator::midpoint, "#3F6FB5", 9},
    {Integrator::heun, "#3F6FB5", 11},
    {Integrator::implicit_midpoint, "#3F6FB5", 8},
    {Integrator::trapezoid, "#3F6FB5", 10},
    {Integrator::rk4, palette::torsional, 13},
    {Integrator::dopri5, palette::linear, 5},
};

// Id of a figure: letters, digits and underscores, not beginning with a digit.
std::string id_of(const char* kind, const std::string& name) {
  std::string id = kind;
  for (const char c : name)
    id += std::isalnum(static_cast<unsigned char>(c)) ? std::string(1, c) : "_";
  return id;
}

// "angle [rad]" has the unit "rad".
std::string unit_of(const std::string& reading) {
  if (reading == kEventFunction) return "any unit";
  const std::size_t open = reading.find('['), close = reading.find(']');
  if (open == std::string::npos || close == std::string::npos || close < open) return "";
  const std::string unit = reading.substr(open + 1, close - open - 1);
  return replace_all(replace_all(unit, "s2", "s²"), "m2", "m²");
}
double largest(const std::vector<double>& values) {
  const auto [low, high] = finite_range({&values});
  return low > high ? 0 : std::max(std::abs(low), std::abs(high));
}

// Readings of one unit and similar size share a panel.
std::vector<std::vector<std::size_t>> panels_of(const CaseCurves& curves) {
  constexpr double kMuchLarger = 8;
  std::vector<std::vector<std::size_t>> panels;
  for (std::size_t i = 0; i < curves.names.size(); ++i) {
    if (curves.values[i].empty()) continue;
    const auto same_unit = [&](const auto& panel) {
      return unit_of(curves.names[panel[0]]) == unit_of(curves.names[i]);
    };
    const double mine = largest(curves.values[i]);
    const auto alike = [&](const auto& panel) {
      const double its = largest(curves.values[panel[0]]);
      return same_unit(panel) && mine <= kMuchLarger * its && its <= kMuchLarger * mine;
    };
    auto panel = std::ranges::find_if(panels, alike);
    if (panel == panels.end() && panels.size() == kMaxPanels)
      panel = std::ranges::find_if(panels, same_unit);
    if (panel != panels.end())
      panel->push_back(i);
    else if (panels.size() < kMaxPanels)
      panels.push_back({i});
  }
  return panels;
}

// All lines, then all points, so that the points are the last in the legend.
std::string panel_plots(Gnuplot& gnuplot, const CaseCurves& curves,
                        const std::vector<std::size_t>& panel) {
  std::string lines, points;
  for (std::size_t k = 0; k < panel.size(); ++k) {
    const std::size_t i = panel[k];
    const LineStyle& style = kLines[k % std::size(kLines)];
    lines +=
        fmt::format("{}{} with lines lw 1.8 dt {} lc '{}' title {}", lines.empty() ? "plot " : ", ",
                    gnuplot.curve(curves.t, curves.values[i], kStretches), style.dash, style.colour,
                    in_quotes(curves.names[i].substr(0, curves.names[i].find(" ["))));
    const std::size_t known = std::min(curves.exact_t.size(), curves.exact[i].size());
    if (known > 0)
      points += fmt::format(
          ", {} with points pt 6 ps 0.65 lw 1.3 lc '#111111' {}",
          gnuplot.data(
              {{curves.exact_t.begin(), curves.exact_t.begin() + std::ptrdiff_t(known)},
               {curves.exact[i].begin(), curves.exact[i].begin() + std::ptrdiff_t(known)}}),
          points.empty() ? "title 'exact'" : "notitle");
  }
  return lines + points;
}

// Lines of a gnuplot script for an axis, "x" or "y".

// About this number of tics, at multiples of 1, 2 or 5 times a power of ten.
std::string tics(const char* axis, double low, double high, int about) {
  const double wish = (high - low) / about;
  if (!(wish > 0) || !std::isfinite(wish)) return "";
  return fmt::format("set {}tics {:.9g}\n", axis, round_step(wish));
}

// Around all finite values, with a margin; a larger one around constant values.
std::string range_of(const std::vector<const std::vector<double>*>& all) {
  auto [low, high] = finite_range(all);
  if (low > high) return "";
  const double size = std::max(std::abs(low), std::abs(high));
  double margin = 0.08 * (high - low);
  if (high - low <= 1e-6 * size || size == 0) margin = size > 0 ? 0.5 * size : 1;
  low -= margin, high += margin;
  return fmt::format("set yrange [{:.9g}:{:.9g}]\n", low, high) + tics("y", low, high, 5);
}

// Tics at powers of ten; in less than a decade and a half also at 2 and 5 times them.
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

}  // namespace

std::string motion_figure(Gnuplot& gnuplot, const std::string& name, const CaseCurves& curves) {
  const auto panels = panels_of(curves);
  if (panels.empty() || curves.t.size() < 2) return "";
  constexpr int kPanel = 165, kRest = 50, kEntry = 20, kAround = 14;
  int height = kRest;
  std::vector<int> heights;  // of panels, at least that of the legend
  for (const auto& panel : panels) {
    heights.push_back(std::max(kPanel, kEntry * static_cast<int>(panel.size() + 1) + 2 * kAround));
    height += heights.back();
  }
  std::string script = "set multiplot\nset lmargin at screen 0.105\nset rmargin at screen 0.80\n";
  const double known = curves.exact_t.empty() ? 0 : curves.exact_t.back();
  const double end = std::max(curves.t.back(), known);
  // A point beyond the border is not drawn; data have seven digits.
  script += fmt::format("set xrange [0:{:.9g}]\n", end * (1 + 1e-6)) + tics("x", 0, end, 8);
  int above = 0;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const double top = 1 - double(above + kAround) / height;
    above += heights[p];
    const double bottom = 1 - double(above - kAround) / height;
    const std::string unit = unit_of(curves.names[panels[p][0]]);
    script +=
        fmt::format("set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n", top, bottom);
    script += fmt::format("set ylabel {} offset 0.8,0\n",
                          in_quotes(unit.empty() ? "[1]" : "[" + unit + "]"));
    script += fmt::format("set key at screen 0.812,{:.4f} left top Left reverse\n", top);
    script += p + 1 == panels.size() ? "set format x '%g'\nset xlabel 'time [s]' offset 0,0.3\n"
                                     : "set format x ''\nunset xlabel\n";
    std::vector<const std::vector<double>*> shown;
    for (const std::size_t i : panels[p])
      shown.insert(shown.end(), {&curves.values[i], &curves.exact[i]});
    script += range_of(shown) + panel_plots(gnuplot, curves, panels[p]) + "\n";
  }
  return gnuplot.svg(id_of("m", name), name + ": readings over time, run and exact", 900, height,
                     script + "unset multiplot\n");
}

std::string error_figure(Gnuplot& gnuplot, const std::string& name, const CaseCurves& curves,
                         double tolerance) {
  constexpr double kMaxError = 10, kMinError = 1e-17;
  double low = HUGE_VAL, high = 0, short_step = HUGE_VAL, long_step = 0;
  std::string plots;
  for (const SchemeStyle& style : kSchemes)
    for (const ErrorCurve& curve : curves.errors) {
      if (curve.integrator != style.integrator) continue;
      std::vector<double> x, y;
      for (std::size_t i = 0; i < curve.step.size(); ++i) {
        if (curve.error[i] > kMaxError) continue;
        x.push_back(curve.step[i]);
        y.push_back(std::max(curve.error[i], kMinError));
        low = std::min(low, y.back()), high = std::max(high, y.back());
        short_step = std::min(short_step, x.back()), long_step = std::max(long_step, x.back());
      }
      if (x.empty()) continue;
      const std::string slope = curve.order ? fmt::format("  {:.2f}", *curve.order) : "";
      plots += fmt::format("{}{} with linespoints lw 1.5 pt {} ps 0.6 lc '{}' title {}",
                           plots.empty() ? "plot " : ", ", gnuplot.data({x, y}), style.point,
                           style.colour, in_quotes(integrator_name(curve.integrator) + slope));
    }
  if (plots.empty()) return "";
  if (tolerance > 0) {
    plots += fmt::format(", {:g} with lines dt (4,4) lw 1.2 lc '{}' title 'tolerance'", tolerance,
                         palette::ink);
    low = std::min(low, tolerance), high = std::max(high, tolerance);
  }
  const std::string script =
      "set logscale xy\nset termoption enhanced\n" + log_axis("x", short_step, long_step) +
      log_axis("y", low, high) +
      "set lmargin at screen 0.155\nset rmargin at screen 0.625\nset tmargin at screen 0.96\n"
      "set bmargin at screen 0.19\nset xlabel 'step [s]' offset 0,0.3\n"
      "set ylabel 'error' offset 0.6,0\n"
      "set key noenhanced at screen 0.64,0.975 left top Left reverse samplen 1.6 spacing 1.12 "
      "font ',11.5'\n";
  return gnuplot.svg(id_of("e", name), name + ": error against step, with slopes", 510, 310,
                     script + plots);
}

std::string energy_figure(Gnuplot& gnuplot, const std::string& name, const CaseCurves& curves) {
  if (curves.t.size() < 2) return "";
  std::string script =
      "set lmargin at screen 0.175\nset rmargin at screen 0.955\nset tmargin at screen 0.90\n"
      "set bmargin at screen 0.19\nset xlabel 'time [s]' offset 0,0.3\nunset key\n";
  script +=
      fmt::format("set xrange [0:{:g}]\n", curves.t.back()) + tics("x", 0, curves.t.back(), 5);
  std::vector<const std::vector<double>*> shown;
  for (const auto& energy : curves.energy) shown.push_back(&energy);
  script += range_of(shown);
  script += fmt::format("set label 1 {} at graph 0,1.045 left font ',12' textcolor '#333333'\n",
                        in_quotes(curves.energy_label));
  if (curves.energy_is_relative) script += "set format y '%.2g'\n";
  // The colours of the motion figure.
  for (std::size_t i = 0; i < curves.energy.size(); ++i)
    script += fmt::format(
        "{}{} with lines lw 1.6 lc '{}'", i == 0 ? "plot " : ", ",
        gnuplot.curve(curves.t, curves.energy[i], kStretches),
        curves.energy.size() == 1 ? palette::ink : kLines[i % std::size(kLines)].colour);
  return gnuplot.svg(id_of("n", name), name + ": energy over time", 510, 310, script);
}

}  // namespace twinarm::compare_page
