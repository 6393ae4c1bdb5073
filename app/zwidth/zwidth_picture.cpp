// The plane of K and B with its laws, and the energy behind a delay.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/plot/gnuplot.h"
#include "app/zwidth/zwidth.h"

namespace twinarm {
namespace {

constexpr int kPlotWidth = 1200, kPlotHeight = 560;

struct LawCurve {
  std::vector<double> B, K;
};
template <class Law>
LawCurve law_curve(double from, double to, Law&& law) {
  LawCurve curve;
  for (int n = 0; n <= 200; ++n) {
    const double B = from * std::pow(to / from, n / 200.0), K = law(B);
    if (!(K > 0)) continue;
    curve.B.push_back(B);
    curve.K.push_back(K);
  }
  return curve;
}

std::string plane_script(Gnuplot& gnuplot, const WallPlane& plane) {
  const SampledDevice& d = plane.device;
  const double from = plane.stable_B.front(), to = plane.stable_B.back();
  const LawCurve colgate =
      law_curve(from, d.damping, [&](double B) { return colgate_stiffness(d, B); });
  const LawCurve uncoupled =
      law_curve(from, to, [&](double B) { return uncoupled_stiffness(d, B); });
  const auto curve = [&](const LawCurve& c) { return gnuplot.data({c.B, c.K}); };
  double top = 100, bottom = 1e9;
  for (const double K : plane.stable_K) top = std::max(top, K);
  for (const double K : plane.passive_K) bottom = std::min(bottom, K);
  bottom = std::min({bottom, top / 100});
  std::string text = fmt::format(
      "set title 'Walls of the device alone: b = {:g} N s/m, m = {:g} g, {:g} Hz'\n"
      "set logscale xy\nset xrange [{:.5g}:{:.5g}]\nset yrange [{:.5g}:{:.5g}]\n"
      "set xlabel 'damping of the wall, B [N s/m]'\nset ylabel 'stiffness of the wall, K [N/m]'\n"
      "set format '%g'\nset key bottom right Left reverse\nplot ",
      d.damping, 1e3 * d.mass, d.rate, from, to * 1.3, bottom / 2, top * 4);
  if (!colgate.B.empty())
    text += fmt::format(
        "{} with filledcurves x1 fc '#CFE3F2' notitle, {} with lines lw 2 lc '{}' title "
        "'Colgate: b = K T/2 + |B|', ",
        curve(colgate), curve(colgate), palette::linear);
  text += fmt::format(
      "{} with lines lw 2 dt 2 lc '{}' title 'K = (b + B)/(T/2 + t_d)', "
      "{} with points pt 7 ps 0.8 lc '{}' title 'stable up to here (runs)'",
      curve(uncoupled), palette::torsional, gnuplot.data({plane.stable_B, plane.stable_K}),
      palette::dvr);
  if (!plane.passive_B.empty())
    text += fmt::format(", {} with points pt 5 ps 0.8 lc '{}' title 'no energy out (runs)'",
                        gnuplot.data({plane.passive_B, plane.passive_K}), palette::ink);
  return text + "\n";
}

constexpr double kDrawnDelay = 0.1;  // [s]

bool is_prompt(const DelayRow& row) {
  return row.delay == 0;
}

std::string delay_script(Gnuplot& gnuplot, const std::vector<DelayRow>& delays) {
  std::string text =
      "unset logscale\nset autoscale\nset title 'Energy of the hand behind a delay of 100 ms each "
      "way'\nset xlabel 'time [s]'\nset ylabel 'energy put in by the hand [mJ]'\n"
      "set key bottom right Left reverse\nset xrange [0:8]\n";
  double top = 1;  // what runs away leaves the picture
  for (const DelayRow& row : delays)
    if (is_prompt(row))
      for (const double E : row.energy) top = std::max(top, 1e3 * E);
  text += fmt::format("set yrange [{:.5g}:{:.5g}]\n", -3 * top, 1.5 * top) +
          "plot 0 with lines lc '#9A9A9A' notitle";
  for (const DelayRow& row : delays) {
    const bool late = !is_prompt(row);
    if (late && (row.delay != kDrawnDelay || row.jitter > 0 || row.loss > 0)) continue;
    std::vector<double> energy;
    for (const double E : row.energy) energy.push_back(1e3 * E);
    if (!late && row.control) continue;
    text += fmt::format(", {} with lines lw {} lc '{}' title '{}'", gnuplot.curve(row.t, energy),
                        late ? 2 : 4,
                        !late         ? palette::kvr
                        : row.control ? palette::linear
                                      : palette::dvr,
                        !late         ? "no delay"
                        : row.control ? "with the passivity controller"
                                      : "without");
  }
  return text + "\n";
}

std::string whole_script(Gnuplot& gnuplot, const ZwidthResult& result) {
  return "set multiplot layout 1,2 margins 0.085,0.98,0.12,0.92 spacing 0.09\n" +
         plane_script(gnuplot, result.plane) + delay_script(gnuplot, result.delays) +
         "unset multiplot\n";
}

}  // namespace

std::string zwidth_svg(const ZwidthResult& result) {
  Gnuplot gnuplot;
  return gnuplot.svg("zwidth", "walls that a hand device can render", kPlotWidth, kPlotHeight,
                     whole_script(gnuplot, result));
}

std::string zwidth_png(const ZwidthResult& result) {
  Gnuplot gnuplot;
  return gnuplot.png("zwidth", kPlotWidth, kPlotHeight, whole_script(gnuplot, result));
}

}  // namespace twinarm
