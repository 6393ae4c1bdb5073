// Output of `twinarm zwidth`: table, JSON, CSV, pictures.
#include <fmt/format.h>

#include <numbers>

#include "app/data/json_writer.h"
#include "app/data/tables.h"
#include "app/plot/gnuplot.h"
#include "app/zwidth/zwidth.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

std::string short_cell(double value, int digits = 1) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}

std::string walls_text(const std::vector<WallRow>& walls) {
  TextTable table({"virtual walls, device alone", "delay", "b", "stable K", "law", "passive K",
                   "Colgate", "passive B", "quantized K", "Abbott"});
  for (const WallRow& row : walls)
    table.add({fmt::format("{:g} Hz", row.device.rate), fmt::format("{} ticks", row.device.delay),
               fmt::format("{:g}", row.device.damping), short_cell(row.stable),
               short_cell(row.stable_law), short_cell(row.passive), short_cell(row.passive_law),
               short_cell(row.passive_damping, 3), short_cell(row.quantized),
               short_cell(row.quantized_law)});
  return table.str() +
         fmt::format(
             "  stable: at B = {:g} N s/m, free device; passive K: at B = 0;\n  quantized: passive "
             "with friction {:g} N and encoder resolution {:g} mm. K in N/m, B and b in N s/m.\n",
             walls.front().wall_damping, walls.front().device.friction,
             1e3 * walls.front().device.resolution);
}

std::string series_text(const std::vector<SeriesRow>& series) {
  TextTable table({"wall through a coupling [N/m]", "wall", "rendered", "series law"});
  for (const SeriesRow& row : series)
    table.add({fmt::format("coupling {:g}", row.coupling), fmt::format("{:g}", row.wall),
               short_cell(row.rendered, 2), short_cell(row.law, 2)});
  return table.str();
}

std::string delays_text(const std::vector<DelayRow>& delays) {
  TextTable table({"delay each way", "control", "minimum E [mJ]", "one tick [mJ]", "passive",
                   "final E [mJ]", "force [N]", "final amplitude [mm]"});
  for (const DelayRow& row : delays)
    table.add({row.name, row.control ? "yes" : "no", short_cell(1e3 * row.lowest, 3),
               short_cell(1e3 * row.tick_work, 3), row.is_passive() ? "yes" : "NO",
               short_cell(1e3 * row.end, 2), short_cell(row.force, 2),
               short_cell(1e3 * row.amplitude, 2)});
  return table.str() +
         "  E: energy put in by the operator; E < 0: the robot has returned more than it "
         "received.\n"
         "  jitter: 80 to 120 ms; loss: 30 % of the packets.\n";
}

std::string follows_text(const std::vector<TrackingRow>& follows) {
  TextTable table({"tracking errors", "motion", "joint", "driven", "max", "mean", "unit"});
  for (const TrackingRow& row : follows) {
    const double unit = row.slides ? 1e3 : 180 / std::numbers::pi;
    table.add({row.robot, row.motion, row.joint, row.driven ? "yes" : "no",
               short_cell(unit * row.max, 3), short_cell(unit * row.mean, 3),
               row.slides ? "mm" : "deg"});
  }
  return table.str() +
         "  Implicit joint springs of 50 rad/s, critically damped for the inertia at the start; "
         "with gravity.\n";
}

void write(JsonWriter& json, const WallRow& row) {
  json.object({{"rate", row.device.rate},
               {"delay_ticks", row.device.delay},
               {"mass", row.device.mass},
               {"damping", row.device.damping},
               {"friction", row.device.friction},
               {"resolution", row.device.resolution},
               {"wall_damping", row.wall_damping},
               {"stable_stiffness", row.stable},
               {"stable_stiffness_law", row.stable_law},
               {"passive_stiffness", row.passive},
               {"passive_stiffness_law", row.passive_law},
               {"passive_damping", row.passive_damping},
               {"stepped_stiffness", row.quantized},
               {"stepped_stiffness_law", row.quantized_law}});
}

void write(JsonWriter& json, const SeriesRow& row) {
  json.object({{"coupling", row.coupling},
               {"wall", row.wall},
               {"rendered_stiffness", row.rendered},
               {"law", row.law}});
}

void write(JsonWriter& json, const DelayRow& row) {
  json.object({{"name", row.name},
               {"delay", row.delay},
               {"jitter", row.jitter},
               {"loss", row.loss},
               {"control", row.control},
               {"lowest_energy", row.lowest},
               {"end_energy", row.end},
               {"tick_work", row.tick_work},
               {"passive", row.is_passive()},
               {"swing", row.amplitude},
               {"force", row.force},
               {"t", row.t},
               {"energy", row.energy},
               {"place", row.position}});
}

void write(JsonWriter& json, const TrackingRow& row) {
  json.object({{"robot", row.robot},
               {"hand", row.motion},
               {"joint", row.joint},
               {"driven", row.driven},
               {"unit", row.slides ? "m" : "rad"},
               {"max", row.max},
               {"mean", row.mean}});
}

template <class Row>
void write_all(JsonWriter& json, const char* key, const std::vector<Row>& rows) {
  json.key(key).list(rows, [&](const Row& row) { write(json, row); });
}

constexpr int kPlotWidth = 1200, kPlotHeight = 560;

using LawCurve = std::vector<std::vector<double>>;  // B, K
template <class Law>
LawCurve law_curve(double from, double to, Law&& law) {
  LawCurve curve(2);
  for (int n = 0; n <= 200; ++n) {
    const double B = from * std::pow(to / from, n / 200.0), K = law(B);
    if (!(K > 0)) continue;
    curve[0].push_back(B);
    curve[1].push_back(K);
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
  double top = 100, bottom = 1e9;
  for (const double K : plane.stable_K) top = std::max(top, K);
  for (const double K : plane.passive_K) bottom = std::min(bottom, K);
  bottom = std::min({bottom, top / 100});
  std::string text = fmt::format(
      "set title 'Virtual walls, device alone: b = {:g} N s/m, m = {:g} g, {:g} Hz'\n"
      "set logscale xy\nset xrange [{:.5g}:{:.5g}]\nset yrange [{:.5g}:{:.5g}]\n"
      "set xlabel 'wall damping B [N s/m]'\nset ylabel 'wall stiffness K [N/m]'\n"
      "set format '%g'\nset key bottom right Left reverse\nplot ",
      d.damping, 1e3 * d.mass, d.rate, from, to * 1.3, bottom / 2, top * 4);
  if (!colgate[0].empty())
    text += fmt::format(
        "{} with filledcurves x1 fc '#CFE3F2' notitle, {} with lines lw 2 lc '{}' title "
        "'Colgate: b = K T/2 + |B|', ",
        gnuplot.data(colgate), gnuplot.data(colgate), palette::linear);
  text += fmt::format(
      "{} with lines lw 2 dt 2 lc '{}' title 'K = (b + B)/(T/2 + t_d)', "
      "{} with points pt 7 ps 0.8 lc '{}' title 'stability limit (runs)'",
      gnuplot.data(uncoupled), palette::torsional, gnuplot.data({plane.stable_B, plane.stable_K}),
      palette::dvr);
  if (!plane.passive_B.empty())
    text += fmt::format(", {} with points pt 5 ps 0.8 lc '{}' title 'passivity limit (runs)'",
                        gnuplot.data({plane.passive_B, plane.passive_K}), palette::ink);
  return text + "\n";
}

std::string delay_script(Gnuplot& gnuplot, const std::vector<DelayRow>& delays) {
  std::string text =
      "unset logscale\nset autoscale\nset title 'Energy put in, with a delay of 100 ms each "
      "way'\nset xlabel 'time [s]'\nset ylabel 'energy put in by the operator [mJ]'\n"
      "set key bottom right Left reverse\nset xrange [0:8]\n";
  constexpr double kDrawnDelay = 0.1;  // [s]
  double top = 1;                      // growing curves leave the picture
  for (const DelayRow& row : delays)
    if (row.delay == 0)
      for (const double E : row.energy) top = std::max(top, 1e3 * E);
  text += fmt::format("set yrange [{:.5g}:{:.5g}]\n", -3 * top, 1.5 * top) +
          "plot 0 with lines lc '#9A9A9A' notitle";
  for (const DelayRow& row : delays) {
    const bool late = row.delay != 0;
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
                        : row.control ? "with passivity controller"
                                      : "without controller");
  }
  return text + "\n";
}

std::string whole_script(Gnuplot& gnuplot, const ZwidthResult& result) {
  return "set multiplot layout 1,2 margins 0.085,0.98,0.12,0.92 spacing 0.09\n" +
         plane_script(gnuplot, result.plane) + delay_script(gnuplot, result.delays) +
         "unset multiplot\n";
}

}  // namespace

std::string zwidth_table(const ZwidthResult& result) {
  return walls_text(result.walls) + "\n" + series_text(result.series) + "\n" +
         delays_text(result.delays) + "\n" + follows_text(result.follows);
}

std::string zwidth_json(const ZwidthResult& result) {
  return answer_text([&](JsonWriter& json) {
    write_all(json, "walls", result.walls);
    json.key("plane").object({{"stable_B", result.plane.stable_B},
                              {"stable_K", result.plane.stable_K},
                              {"passive_B", result.plane.passive_B},
                              {"passive_K", result.plane.passive_K}});
    write_all(json, "series", result.series);
    write_all(json, "delays", result.delays);
    write_all(json, "following", result.follows);
  });
}

std::string zwidth_csv(const ZwidthResult& result) {
  std::string text =
      "rate[Hz],delay[ticks],b[N s/m],B[N s/m],stable_K[N/m],stable_law[N/m],passive_K[N/m],"
      "passive_law[N/m],passive_B[N s/m],stepped_K[N/m],stepped_law[N/m]\n";
  for (const WallRow& row : result.walls) {
    const double numbers[] = {row.device.rate,     static_cast<double>(row.device.delay),
                              row.device.damping,  row.wall_damping,
                              row.stable,          row.stable_law,
                              row.passive,         row.passive_law,
                              row.passive_damping, row.quantized,
                              row.quantized_law};
    for (std::size_t c = 0; c < std::size(numbers); ++c)
      text += (c ? "," : "") + (std::isfinite(numbers[c]) ? number_text(numbers[c]) : "");
    text += "\n";
  }
  return text;
}

std::string zwidth_svg(const ZwidthResult& result) {
  Gnuplot gnuplot;
  return gnuplot.svg("zwidth", "Virtual walls of a haptic device", kPlotWidth, kPlotHeight,
                     whole_script(gnuplot, result));
}

std::string zwidth_png(const ZwidthResult& result) {
  Gnuplot gnuplot;
  return gnuplot.png("zwidth", kPlotWidth, kPlotHeight, whole_script(gnuplot, result));
}

}  // namespace twinarm
