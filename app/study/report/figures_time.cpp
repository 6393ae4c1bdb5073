// Figures over time: 6a, 6b, 7c and 7d of the paper, the errors, and the run into the box.

#include "app/study/findings/findings.h"
#include "app/study/report/report_slots.h"

namespace twinarm {
namespace {

// One panel of a figure with joint 1 above joint 2 on one time axis.
std::string panel(int index, const std::string& label, double duration) {
  const double top = index == 0 ? 0.91 : 0.48, bottom = index == 0 ? 0.575 : 0.145;
  return fmt::format("set tmargin at screen {}\nset bmargin at screen {}\n", top, bottom) +
         "set lmargin at screen 0.085\nset rmargin at screen 0.985\n" +
         fmt::format("set xrange [0:{}]\nset ylabel {} offset 0.8,0 textcolor '#333333'\n",
                     duration, in_quotes(label)) +
         (index == 0 ? "set format x ''\nunset xlabel\n"
                       "set key at screen 0.985,0.99 right top horizontal\n"
                     : "set format x '%g'\nset xlabel 'time [s]' offset 0,0.3 textcolor '#333333'\n"
                       "unset key\n");
}

// Limits with a margin, and tics at round angles.
std::string angle_axis(const std::vector<double>& a, const std::vector<double>& b) {
  const auto [low, high] = finite_range({&a, &b});
  const double margin = std::max(0.06 * (high - low), 1.0), span = high - low;
  const double tics = span > 400 ? 180 : span > 250 ? 90 : span > 85 ? 45 : span > 40 ? 15 : 5;
  return fmt::format("set yrange [{}:{}]\nset ytics {}\n", low - margin, high + margin, tics);
}

// From zero, with at most six round tics.
std::string value_axis(const std::vector<double>& a, const std::vector<double>& b = {}) {
  const double largest = finite_range({&a, &b}).second, high = largest > 0 ? largest : 1;
  double step = std::pow(10, std::floor(std::log10(high)) - 1);
  for (double factor : {2.0, 2.5, 2.0, 2.0, 2.5})
    if (high / step > 6) step *= factor;
  return fmt::format("set yrange [0:{}]\nset ytics {}\n", 1.06 * high, step);
}

struct ObstaclePanel {
  std::string label;
  std::string plots;   // of gnuplot's plot command
  std::string before;  // its axis
};

// In millimetres for a logarithmic axis; gaps for values that are not positive.
std::vector<double> positive_mm(const std::vector<double>& metres) {
  std::vector<double> values;
  for (double x : metres) values.push_back(x > 0 ? std::max(x * 1e3, 1e-4) : NAN);
  return values;
}

std::vector<ObstaclePanel> obstacle_panels(Gnuplot& gnuplot, const ObstacleRun& run) {
  std::vector<ObstaclePanel> panels;
  for (std::size_t j = 0; j < 2; ++j)
    panels.push_back({fmt::format("joint {} [°]", j + 1),
                      fmt::format("{} with lines lw 4 lc '{}' title 'KVR', {} with lines lw 1.8 lc "
                                  "'{}' title 'DVR'",
                                  gnuplot.curve(run.t, run.q_K_deg[j]), palette::kvr,
                                  gnuplot.curve(run.t, run.q_D_deg[j]), palette::dvr),
                      angle_axis(run.q_K_deg[j], run.q_D_deg[j])});
  const auto add_size = [&](const std::string& label, std::vector<double> size,
                            const std::string& unit, double width) {
    const bool is_large = finite_range({&size, &size}).second > 1e4;
    if (is_large)
      for (double& value : size) value *= 1e-3;
    panels.push_back({fmt::format("{} [{}{}]", label, is_large ? "k" : "", unit),
                      fmt::format("{} with lines lw {} lc '{}' notitle", gnuplot.curve(run.t, size),
                                  width, palette::ink),
                      value_axis(size)});
  };
  const bool linear = run.spec.coupling.type == CouplingSpec::Type::linear;
  add_size(linear ? "coupling force" : "coupling torque", run.coupling,
           run.spec.coupling_force_unit(), 1.8);
  add_size("contact force", run.contact_force, "N", 1.4);
  panels.push_back(
      {"depth behind the face [mm]; line: 0.5 mm",
       fmt::format("0.5 with lines dt (4,4) lw 1.2 lc '{}' notitle, {} with lines lw 4 lc '{}' "
                   "notitle, {} with lines lw 1.8 lc '{}' notitle",
                   palette::faint, gnuplot.data({run.t, positive_mm(run.beyond)}), palette::kvr,
                   gnuplot.data({run.t, positive_mm(run.penetration)}), palette::dvr),
       "set logscale y\nset yrange [1e-4:1e3]\nset offsets 0,0,0,0\nset ytics scale 0.6,0\n"
       "set ytics (0.001, 0.1, 10)\n"});
  return panels;
}

// Column of panels of one coupling.
std::string obstacle_column(Gnuplot& gnuplot, const ObstacleRun& run, double left, double right) {
  std::string script = fmt::format(
      "reset\n{}set lmargin at screen {}\nset rmargin at screen {}\nset xrange [0:{}]\n",
      kFigureStyle, left, right, run.t.back());
  constexpr double kGap = 0.02;  // [s]
  for (const auto& [begin, end] : contact_intervals(run, kGap))
    script += fmt::format(
        "set object rectangle from {},graph 0 to {},graph 1 behind fillcolor "
        "'#F1EDE4' fillstyle solid noborder\n",
        begin, end);
  const std::vector<ObstaclePanel> panels = obstacle_panels(gnuplot, run);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const double top = 0.925 - 0.181 * static_cast<double>(p), bottom = top - 0.138;
    script += fmt::format("set tmargin at screen {}\nset bmargin at screen {}\n", top, bottom);
    script +=
        p == 0
            ? fmt::format(
                  "set label 9 {} at graph 0,1.0 offset 0,2.4 font ',15' "
                  "textcolor '#111111'\n"
                  "set key at graph 1,1.01 right bottom horizontal\n",
                  in_quotes(run.spec.coupling.name == "far" ? "linear coupling, far target"
                                                            : run.spec.coupling.name + " coupling"))
            : "unset label 9\nunset key\n";
    script += p + 1 == panels.size()
                  ? "set format x '%g'\nset xlabel 'time [s]' offset 0,0.3 textcolor '#333333'\n"
                  : "set format x ''\nunset xlabel\n";
    script +=
        fmt::format("set label 7 {} at graph 0,1.0 offset 0,0.7 font ',12' textcolor '#333333'\n",
                    in_quotes(panels[p].label));
    script += panels[p].before + "plot " + panels[p].plots + "\n";
  }
  return script;
}

}  // namespace

// Marks the largest error, which is the number of Table 2.
void draw_angles(Gnuplot& gnuplot, const std::string& name, const RunResult& run) {
  const TrackingSeries& series = run.series;
  std::string script = "set multiplot\n";
  for (std::size_t j = 0; j < 2; ++j) {
    const std::vector<double> q_K = in_degrees(series.q_K[j]), q_D = in_degrees(series.q_D[j]);
    const std::vector<double> error = error_deg(series, j);
    const auto at =
        static_cast<std::size_t>(std::distance(error.begin(), std::ranges::max_element(error)));
    script += panel(static_cast<int>(j), fmt::format("joint {} [°]", j + 1), series.t.back());
    script += angle_axis(q_K, q_D);
    const std::string theory =  // none for E1 and E2
        run.spec.name < std::string("E3")
            ? ""
            : fmt::format("; by linear theory {:.1f}°", run.motion_max_deg[j]);
    script += fmt::format(
        "set arrow 1 from {0},{1} to {0},{2} nohead lw 3 lc '#111111' front\n"
        "set label 1 'largest error {3:.1f}° at {0:.2f} s (bar){4}' at graph 0,1 left offset "
        "0,0.6 font ',11.5' textcolor '#111111'\n",
        series.t[at], q_K[at], q_D[at], error[at], theory);
    script += fmt::format(
        "plot {} with lines lw 4.5 lc '{}' title 'KVR (target)', "
        "{} with lines lw {} lc '{}' title 'DVR (simulated)'\n",
        gnuplot.curve(series.t, q_K), palette::kvr, gnuplot.curve(series.t, q_D),
        series.t.back() > 5 ? 1.2 : 1.8, palette::dvr);
  }
  gnuplot.draw(name, run.spec.name + ": joint angles of KVR and DVR over time", 900, 470,
               script + "unset multiplot\n");
}

// |error| of E1 and E2 over all operators, both on one logarithmic axis: median, and a band from
// the 10 % to the 90 % quantile.
void draw_ensembles(Gnuplot& gnuplot, const std::vector<Ensemble>& ensembles) {
  std::string script = "set multiplot\n";
  for (std::size_t j = 0; j < 2; ++j) {
    script += panel(static_cast<int>(j), fmt::format("|error|, joint {} [°]", j + 1),
                    ensembles.front().band[j].t.back());
    script += "set logscale y\nset yrange [2e-3:50]\nset ytics (.01, .1, 1, 10)\nplot ";
    const std::pair<const char*, const char*> styles[] = {{palette::torsional, "E1, torsional"},
                                                          {palette::linear, "E2, linear"}};
    for (std::size_t e = 0; e < ensembles.size(); ++e) {
      const ErrorBand& band = ensembles[e].band[j];
      const auto& [colour, words] = styles[e];
      script += fmt::format(
          "{}{} with filledcurves fs transparent solid 0.25 noborder lc '{}' title '{}, 10 to 90 "
          "%', {} with lines lw 1.4 lc '{}' notitle",
          e ? ", " : "", gnuplot.data({band.t, band.p10, band.p90}), colour, words,
          gnuplot.curve(band.t, band.median), colour);
    }
    script += "\n";
  }
  gnuplot.draw("fig6_band", "Absolute errors of E1 and E2 over all operators", 900, 470,
               script + "unset multiplot\n");
}

void draw_errors(Gnuplot& gnuplot, const RunResult& torsional, const RunResult& linear) {
  std::string script = "set multiplot\n";
  for (std::size_t j = 0; j < 2; ++j) {
    script += panel(static_cast<int>(j), fmt::format("|error|, joint {} [°]", j + 1),
                    torsional.series.t.back());
    std::vector<double> shown[] = {error_deg(torsional.series, j), error_deg(linear.series, j)};
    shown[0].push_back(std::abs(torsional.peak_deg[j]));
    shown[1].push_back(std::abs(linear.peak_deg[j]));
    script += "unset arrow\n" + value_axis(shown[0], shown[1]);
    if (j == 0) script += "set key at screen 0.085,0.99 left top horizontal Left reverse\n";
    for (const auto& [run, colour] :
         {std::pair{&torsional, palette::torsional}, std::pair{&linear, palette::linear}})
      script += fmt::format(
          "set arrow from 0,first {0} to {1},first {0} nohead dt (2,3) lw 1.2 lc '{2}'\n",
          std::abs(run->peak_deg[j]), run->series.t.back(), colour);
    for (int reversal = 1; reversal < torsional.series.t.back() - 0.01; ++reversal)
      script += fmt::format(
          "set arrow from {0},graph 0 to {0},graph 1 nohead dt (4,4) lw 1 lc '{1}' back\n",
          reversal, palette::faint);
    script += fmt::format(
        "plot {} with lines lw 1.8 lc '{}' title 'E3, torsional', {} with lines "
        "lw 2.6 lc '{}' title 'E4, linear'\n",
        gnuplot.curve(torsional.series.t, error_deg(torsional.series, j)), palette::torsional,
        gnuplot.curve(linear.series.t, error_deg(linear.series, j)), palette::linear);
  }
  gnuplot.draw("errors", "Absolute error of E3 and E4 over time", 900, 400,
               script + "unset multiplot\n");
}

void draw_obstacle(Gnuplot& gnuplot, const std::vector<ObstacleRun>& runs) {
  std::string script = "set multiplot\n";
  const auto columns = static_cast<double>(runs.size());
  for (std::size_t c = 0; c < runs.size(); ++c) {
    const auto index = static_cast<double>(c);
    script +=
        obstacle_column(gnuplot, runs[c], index / columns + 0.065, (index + 1) / columns - 0.015);
  }
  gnuplot.draw("obstacle", "The runs into a box", 1200, 980, script + "unset multiplot\n");
}

}  // namespace twinarm
