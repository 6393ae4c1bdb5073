// Figure of the identification from Table 2: intervals of all parameters, by law.
#include <fmt/format.h>

#include <algorithm>

#include "app/study/report/figures_detail.h"

namespace twinarm {
namespace {

constexpr double kMaxFactor = 12;  // of the axis

struct Bars {
  std::vector<double> y, low, high;
};

const std::vector<std::string> kNames{"k1", "b1", "k2", "b2", "mass of arm 2"};
const std::vector<std::string> kKeys{"k1", "b1", "k2", "b2", "arm2_mass_scale"};

// Fits that agree with a row of the paper, and the others.
struct Panel {
  Bars agree, disagree;
};
Panel panel_of(const std::vector<Identification>& all, const std::vector<double>& rates,
               const std::string& row, const std::string& key) {
  const std::vector<FamilyLaw>& laws = family_laws();
  const double rows = static_cast<double>(laws.size()), count = static_cast<double>(rates.size());
  Panel panel;
  for (const Identification& found : all) {
    if (found.row != row) continue;
    const auto law = static_cast<double>(
        std::find_if(laws.begin(), laws.end(),
                     [&](const FamilyLaw& some) { return some.name == found.law; }) -
        laws.begin());
    const auto rate =
        static_cast<double>(std::find(rates.begin(), rates.end(), found.fit.rate) - rates.begin());
    const auto profile = std::find_if(found.profiles.begin(), found.profiles.end(),
                                      [&](const Profile& some) { return some.parameter == key; });
    if (profile == found.profiles.end()) continue;
    const Identification::Interval in = found.interval(*profile);
    const double best = found.fit.value(key);
    Bars& bars = found.fit.objective <= 1 ? panel.agree : panel.disagree;
    bars.y.push_back(rows - 1 - law + 1 / (count + 1) * ((count - 1) / 2 - rate));
    bars.low.push_back(in.open_low ? 1 / kMaxFactor : in.low / best);
    bars.high.push_back(in.open_high ? kMaxFactor : in.high / best);
  }
  return panel;
}

std::string plot_of(Gnuplot& gnuplot, const Panel& panel, const char* colour) {
  std::string plots;
  const auto add = [&](const Bars& bars, const char* of_bars, int width) {
    if (bars.y.empty()) return;
    std::vector<double> length;
    for (std::size_t i = 0; i < bars.y.size(); ++i) length.push_back(bars.high[i] - bars.low[i]);
    plots += fmt::format("{}{} using 2:1:3:(0) with vectors nohead lw {} lc '{}'",
                         plots.empty() ? "plot " : ", ", gnuplot.data({bars.y, bars.low, length}),
                         width, of_bars);
  };
  add(panel.disagree, palette::faint, 2);
  add(panel.agree, colour, 5);
  return plots.empty() ? "" : plots + "\n";
}

}  // namespace

void draw_identification(Gnuplot& gnuplot, const StudyResults& results) {
  const std::vector<Identification>& all = results.identifications;
  if (all.empty()) return;
  constexpr const char* kColours[] = {palette::torsional, palette::linear};
  std::vector<double> rates;
  for (const Identification& found : all) rates.push_back(found.fit.rate);
  std::sort(rates.begin(), rates.end());
  rates.erase(std::unique(rates.begin(), rates.end()), rates.end());
  const std::vector<FamilyLaw>& laws = family_laws();
  const double rows = static_cast<double>(laws.size());
  std::string tics;
  for (std::size_t l = 0; l < laws.size(); ++l)
    tics += fmt::format("{}{} {}", l == 0 ? "" : ", ", in_quotes(laws[l].words),
                        rows - 1 - static_cast<double>(l));
  std::string script = fmt::format(
      "set multiplot\nset tics scale 0.5\nset logscale x\nset xrange [{}:{}]\nset yrange "
      "[-0.6:{}]\n"
      "set xtics ('1/5' 0.2, '1' 1, '5' 5)\nunset key\nset grid x\n",
      1 / kMaxFactor, kMaxFactor, rows - 0.4);
  for (std::size_t r = 0; r < 2; ++r) {
    const char* row = r == 0 ? "E3" : "E4";
    for (std::size_t p = 0; p < kNames.size(); ++p) {
      script += fmt::format(
          "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\n"
          "set bmargin at screen {}\n{}\n{}\nset title '{}' offset 0,-0.6\n",
          0.26 + 0.148 * static_cast<double>(p), 0.395 + 0.148 * static_cast<double>(p),
          r == 0 ? 0.94 : 0.46, r == 0 ? 0.56 : 0.08,
          p == 0 ? "set ytics nomirror (" + tics + ")" : "unset ytics",
          r == 1 ? "set xlabel 'relative to the best'" : "unset xlabel",
          fmt::format("{}, {}", row, kNames[p]));
      script += plot_of(gnuplot, panel_of(all, rates, row, kKeys[p]), kColours[r]);
    }
  }
  gnuplot.draw("identify", "Intervals of the parameters of each law that agree with the row", 1100,
               760, script + "unset multiplot\n");
}

}  // namespace twinarm
