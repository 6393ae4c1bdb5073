// Figures over rates and variants.

#include <set>

#include "app/study/report/report.h"
#include "app/study/report/report_slots.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

struct LawStyle {
  const char* name;
  const char* words;
  const char* colour;
  int point;  // gnuplot's number: 7 disc, 5 square, 9 triangle, 13 diamond, 11 triangle down
  const char* dash;
};
constexpr LawStyle kTrialStyles[] = {
    {"printed-torsional", "torsional, as published", palette::torsional, 7, "solid"},
    {"signed-torsional", "torsional, signed damper", "#C58AD0", 5, "solid"},
    {"signed-torsional-ratio", "the same, k2 = 0.2 k1", "#3F6FB5", 9, "(6,4)"},
    {"printed-linear", "linear, as published", palette::linear, 13, "solid"}};
constexpr LawStyle kFitStyles[] = {{"world-", "E3 world (−)", palette::torsional, 7, "solid"},
                                   {"world+", "E3 world (+)", "#C58AD0", 5, "solid"},
                                   {"joint-", "E3 joint (−)", "#3F6FB5", 9, "(6,4)"},
                                   {"joint+", "E3 joint (+)", "#8DB0DD", 11, "(6,4)"}};

std::string line_style(const LawStyle& law) {
  return fmt::format("with linespoints lw 2 dt {} pt {} ps 0.75 lc '{}' title {}", law.dash,
                     law.point, law.colour, in_quotes(law.words));
}

// Tics of a logarithmic rate axis; without a number where they would overlap.
std::string rate_axis(const std::set<double>& rates) {
  std::string tics;
  double last = 0;
  for (double rate : rates) {
    const bool apart = rate > 1.18 * last;
    tics += fmt::format("{}{} {:g}", tics.empty() ? "" : ", ",
                        in_quotes(apart ? fmt::format("{:g}", rate) : ""), rate);
    if (apart) last = rate;
  }
  return fmt::format("set logscale x\nset xrange [{}:{}]\nset xtics ({})\n", *rates.begin() / 1.12,
                     *rates.rbegin() * 1.12, tics);
}

}  // namespace

void draw_rates(Gnuplot& gnuplot, const std::vector<RunResult>& variants) {
  std::map<std::string, std::vector<const RunResult*>> by_law;
  std::set<double> rates;
  for (const RunResult& run : variants)
    if (run.spec.name.starts_with("trial/")) {
      by_law[split(run.spec.name, '/')[1]].push_back(&run);  // of "group/law/rate"
      rates.insert(run.spec.rate);
    }
  std::string script =
      "set multiplot\nset logscale y\nset tmargin at screen 0.92\n"
      "set bmargin at screen 0.17\nset xlabel 'update rate [Hz]'\n";
  script += rate_axis(rates) + "set ytics (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)\n";
  double low = HUGE_VAL, high = 0;
  for (const auto& [law, runs] : by_law)
    for (const RunResult* run : runs)
      if (run->stable) {
        const double theory[] = {std::abs(run->peak_deg[0]), std::abs(run->peak_deg[1])};
        low = std::min({low, run->max_deg[0], run->max_deg[1], theory[0], theory[1]});
        high = std::max({high, run->largest_deg(), theory[0], theory[1]});
      }
  script += fmt::format("set yrange [{}:{}]\n", low / 1.3, high * 1.3);
  for (std::size_t j = 0; j < 2; ++j) {
    script += fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\n"
        "set title 'joint {}' offset 0,-0.6\n{}\n",
        j == 0 ? 0.075 : 0.555, j == 0 ? 0.505 : 0.985, j + 1,
        j == 0 ? "set ylabel 'largest error [°]' offset 0.8,0\n"
                 "set key left bottom Left reverse"
               : "unset ylabel\nunset key");
    std::string plots;
    for (const LawStyle& law : kTrialStyles) {
      std::vector<double> x, y, theory;
      for (const RunResult* run : by_law[law.name]) {
        x.push_back(run->spec.rate);
        y.push_back(run->stable ? run->max_deg[j] : NAN);
        theory.push_back(run->stable ? std::abs(run->peak_deg[j]) : NAN);
      }
      if (!x.empty())
        plots += (plots.empty() ? "plot " : ", ") + gnuplot.data({x, y}) + " " + line_style(law) +
                 ", " + gnuplot.data({x, theory}) +
                 fmt::format(" with lines lw 1 dt (2,3) lc '{}' notitle", law.colour);
    }
    script += plots + "\n";
  }
  gnuplot.draw("rates", "Largest error against the update rate, optimal gains", 900, 430,
               script + "unset multiplot\n");
}

void draw_search(Gnuplot& gnuplot, const StudyResults& results) {
  const Calibration& c = results.calibration;
  const std::vector<double>& rates = results.search_rates;
  constexpr double kFloor = 0.5;  // of the drawn values [%]
  double low = 10, high = 30;     // [%]; the range includes 15 %
  const auto percent_of = [&](const CalibrationEntry& entry) {
    const double percent = 100 * entry.objective;
    if (percent > 0) {
      low = std::max(kFloor, std::min(low, percent));
      high = std::max(high, percent);
    }
    return percent;
  };
  std::vector<double> e3[std::size(kFitStyles)], e4;
  for (const double rate : rates) {
    for (std::size_t l = 0; l < std::size(kFitStyles); ++l)
      e3[l].push_back(percent_of(c.e3(kFitStyles[l].name, rate)));
    e4.push_back(std::max(kFloor, percent_of(c.e4(rate))));
  }
  std::string script =
      rate_axis({rates.begin(), rates.end()}) +
      fmt::format(
          "set logscale y\nset yrange [{}:{}]\nset ytics (0.5, 1, 2, 5, 10, 20, 50, 100, "
          "200, 500)\n",
          low / 1.3, high * 1.4) +
      "set xlabel 'update rate [Hz]'\n"
      "set ylabel 'worst relative error of the four numbers [%]' offset 0.8,0\n"
      "set key outside top center horizontal\n"
      "set arrow from graph 0,first 15 to graph 1,first 15 nohead dt (4,4) lw 1.4 lc '#333333'\n"
      "set label '15 %' at graph 0.005,first 15 left offset 0,0.6 font ',11.5'\n";
  script += fmt::format(
      "set arrow from first {0},graph 0 to first {0},graph 1 nohead lw 7 lc '#EFE6D2' back\nset "
      "label 'chosen: {0:g} Hz' at first {0},graph 0.97 left offset 0.8,0 font ',11.5'\n",
      c.entry("chosen").rate);
  std::string plots = "plot ";
  for (std::size_t l = 0; l < std::size(kFitStyles); ++l)
    plots += gnuplot.data({rates, e3[l]}) + " " + line_style(kFitStyles[l]) + ", ";
  const LawStyle linear{"", "E4 linear", palette::linear, 13, "solid"};
  gnuplot.draw("search", "Best fit to the paper's rows against the update rate", 900, 470,
               script + plots + gnuplot.data({rates, e4}) + " " + line_style(linear));
}

void draw_ablations(Gnuplot& gnuplot, const std::vector<RunResult>& variants) {
  std::vector<const RunResult*> runs;
  double high = 0;
  for (const RunResult& run : variants)
    if (run.spec.name.starts_with("ablation/")) {
      runs.push_back(&run);
      if (run.stable) high = std::max(high, run.largest_deg());
    }
  std::string tics, labels;
  std::vector<double> y[2], x[2], theory[2];
  const auto rows = static_cast<double>(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double row = rows - static_cast<double>(i);
    tics += fmt::format("{}{} {}", i ? ", " : "", in_quotes(runs[i]->spec.title), row);
    for (std::size_t j = 0; j < 2; ++j) {
      const double size = runs[i]->stable ? runs[i]->max_deg[j] : 1.05 * high;
      x[j].push_back(size);
      theory[j].push_back(runs[i]->stable ? std::min(std::abs(runs[i]->peak_deg[j]), 1.15 * high)
                                          : NAN);
      y[j].push_back(row + (j == 0 ? 0.19 : -0.19));
      labels += fmt::format("set label {} at {},{} left offset 0.5,0 font ',11'\n",
                            in_quotes(runs[i]->stable ? fmt::format("{:.1f}", size) : "unstable"),
                            size, y[j].back());
    }
  }
  const auto bars = [&](std::size_t j, const char* colour) {
    return gnuplot.data({x[j], y[j]}) +
           fmt::format(
               " using 1:2:(0):1:($2-0.17):($2+0.17) with boxxyerror fillstyle solid "
               "noborder lc '{}' title 'joint {}'",
               colour, j + 1);
  };
  const auto marks = [&](std::size_t j, const char* title) {
    return gnuplot.data({theory[j], y[j]}) +
           fmt::format(" with points pt 13 ps 0.7 lc '#111111' {}", title);
  };
  gnuplot.draw("ablations", "Largest error of each change to the torsional law", 900,
               110 + 46 * static_cast<int>(runs.size()),
               fmt::format("set ytics ({}) scale 0 font ',11.5'\nset border 1\nset grid noytics\n"
                           "set xrange [0:{}]\nset yrange [0.4:{}]\n"
                           "set xlabel 'largest error [°], 60 Hz, automatic motion'\n"
                           "set lmargin at screen 0.37\nset rmargin at screen 0.97\n"
                           "set key at graph 1,1.0 right bottom horizontal\n{}plot {}, {}, {}, {}",
                           tics, 1.18 * high, rows + 0.6, labels, bars(0, palette::torsional),
                           bars(1, "#C58AD0"), marks(0, "title 'by theory'"), marks(1, "notitle")));
}

void draw_prediction(Gnuplot& gnuplot, const std::vector<RunResult>& variants) {
  constexpr LawStyle kGroups[] = {
      {"trial/", "optimal gains", palette::torsional, 7, ""},
      {"matched/", "matched gains", palette::linear, 13, ""},
      {"explicit/", "50 Hz springs, explicit", "#D2600A", 5, ""},
      {"semi-implicit/", "50 Hz springs, semi-implicit", "#E6A15C", 9, ""},
      {"implicit/", "50 Hz springs, implicit", "#3F6FB5", 11, ""},
      {"held/", "force held", "#8A8A8A", 6, ""},
      {"ablation/", "changes to the law", "#111111", 2, ""}};
  std::string plots;
  double low = HUGE_VAL, high = 0;
  for (const LawStyle& group : kGroups) {
    std::vector<double> x, y;
    for (const RunResult& run : variants)
      for (std::size_t j = 0; j < 2; ++j) {
        const double peak = std::abs(run.peak_deg[j]);
        if (!run.spec.name.starts_with(group.name) || !run.stable || !std::isfinite(peak) ||
            peak <= 0 || run.max_deg[j] <= 0)
          continue;
        x.push_back(peak);
        y.push_back(run.max_deg[j]);
        low = std::min({low, peak, run.max_deg[j]});
        high = std::max({high, peak, run.max_deg[j]});
      }
    if (!x.empty())
      plots += fmt::format(", {} with points pt {} ps 0.8 lw 1.4 lc '{}' title '{}'",
                           gnuplot.data({x, y}), group.point, group.colour, group.words);
  }
  low /= 1.3;
  high *= 1.3;
  gnuplot.draw("prediction", "Predicted peak after a reversal against the measured maximum", 900,
               560,
               fmt::format("set logscale xy\nset xrange [{0}:{1}]\nset yrange [{0}:{1}]\n"
                           "set xtics (0.01, 0.1, 1, 10, 100)\nset ytics (0.01, 0.1, 1, 10, 100)\n"
                           "set samples 200\nset lmargin at screen 0.085\n"
                           "set rmargin at screen 0.68\n"
                           "set key at screen 0.71,0.93 left top Left reverse\n"
                           "set xlabel 'predicted peak after a reversal [°]'\n"
                           "set ylabel 'measured largest error [°]' offset 0.8,0\n"
                           "plot x with lines lw 1.4 lc '#333333' title 'equal', 2*x with lines dt "
                           "(4,4) lw 1 lc '{2}' notitle, x/2 with lines dt (4,4) lw 1 lc '{2}' "
                           "title 'factor 2'{3}\n",
                           low, high, palette::faint, plots));
}

void write_figures(const StudyResults& results, const std::filesystem::path& folder) {
  Gnuplot gnuplot(folder);
  const std::vector<RunResult>& runs = results.reproduction;
  const char* const names[] = {"fig6a", "fig6b", "fig7c", "fig7d"};
  for (std::size_t i = 0; i < runs.size(); ++i) draw_angles(gnuplot, names[i], runs[i]);
  draw_ensembles(gnuplot, results.ensembles);
  draw_errors(gnuplot, runs[2], runs[3]);
  draw_rates(gnuplot, results.variants);
  draw_search(gnuplot, results);
  draw_ablations(gnuplot, results.variants);
  draw_prediction(gnuplot, results.variants);
  draw_obstacle(gnuplot, results.obstacle);
  draw_identification(gnuplot, results);
}

}  // namespace twinarm
