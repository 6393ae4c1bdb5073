// The figure of what Table 2 leaves open: intervals of all parameters, by law.
#include <fmt/format.h>

#include <algorithm>

#include "app/study/report/figures_detail.h"

namespace twinarm {
namespace {

constexpr double kWidest = 12;  // of the axis: a factor

struct Bars {
  std::vector<double> y, low, high;
};

}  // namespace

void draw_identification(Gnuplot& gnuplot, const StudyResults& results) {
  const std::vector<Identification>& all = results.identifications;
  if (all.empty()) return;
  constexpr const char* kColours[] = {palette::torsional, palette::linear};
  const std::vector<std::string> names{"k1", "b1", "k2", "b2", "mass of arm 2"};
  const std::vector<std::string> keys{"k1", "b1", "k2", "b2", "arm2_mass_scale"};
  std::vector<double> rates;
  for (const Identification& found : all) rates.push_back(found.fit.rate);
  std::sort(rates.begin(), rates.end());
  rates.erase(std::unique(rates.begin(), rates.end()), rates.end());
  const std::vector<FamilyLaw>& laws = family_laws();
  const double rows = static_cast<double>(laws.size()),
               each = 1 / (static_cast<double>(rates.size()) + 1);
  std::string tics;
  for (std::size_t l = 0; l < laws.size(); ++l)
    tics += fmt::format("{}{} {}", l == 0 ? "" : ", ", in_quotes(laws[l].words),
                        rows - 1 - static_cast<double>(l));
  std::string script = fmt::format(
      "set multiplot\nset tics scale 0.5\nset logscale x\nset xrange [{}:{}]\nset yrange "
      "[-0.6:{}]\n"
      "set xtics ('1/5' 0.2, '1' 1, '5' 5)\nunset key\nset grid x\n",
      1 / kWidest, kWidest, rows - 0.4);
  for (std::size_t r = 0; r < 2; ++r) {
    const char* row = r == 0 ? "E3" : "E4";
    for (std::size_t p = 0; p < names.size(); ++p) {
      Bars agree, fall_short;
      for (const Identification& found : all) {
        if (found.row != row) continue;
        const auto law = static_cast<double>(
            std::find_if(laws.begin(), laws.end(),
                         [&](const FamilyLaw& some) { return some.name == found.law; }) -
            laws.begin());
        const auto rate = static_cast<double>(
            std::find(rates.begin(), rates.end(), found.fit.rate) - rates.begin());
        const auto profile =
            std::find_if(found.profiles.begin(), found.profiles.end(),
                         [&](const Profile& some) { return some.parameter == keys[p]; });
        if (profile == found.profiles.end()) continue;
        const Identification::Interval in = found.interval(*profile);
        const double best = found.fit.value(keys[p]);
        Bars& bars = found.fit.objective <= 1 ? agree : fall_short;
        bars.y.push_back(rows - 1 - law +
                         each * ((static_cast<double>(rates.size()) - 1) / 2 - rate));
        bars.low.push_back(in.open_low ? 1 / kWidest : in.low / best);
        bars.high.push_back(in.open_high ? kWidest : in.high / best);
      }
      script += fmt::format(
          "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\n"
          "set bmargin at screen {}\n{}\n{}\nset title '{}' offset 0,-0.6\n",
          0.26 + 0.148 * static_cast<double>(p), 0.395 + 0.148 * static_cast<double>(p),
          r == 0 ? 0.94 : 0.46, r == 0 ? 0.56 : 0.08,
          p == 0 ? "set ytics nomirror (" + tics + ")" : "unset ytics",
          r == 1 ? "set xlabel 'over the best'" : "unset xlabel",
          fmt::format("{}, {}", row, names[p]));
      std::string plots;
      const auto add = [&](const Bars& bars, const char* colour, int width) {
        if (bars.y.empty()) return;
        std::vector<double> length;
        for (std::size_t i = 0; i < bars.y.size(); ++i)
          length.push_back(bars.high[i] - bars.low[i]);
        plots += fmt::format("{}{} using 2:1:3:(0) with vectors nohead lw {} lc '{}'",
                             plots.empty() ? "plot " : ", ",
                             gnuplot.data({bars.y, bars.low, length}), width, colour);
      };
      add(fall_short, palette::faint, 2);
      add(agree, kColours[r], 5);
      if (!plots.empty()) script += plots + "\n";
    }
  }
  gnuplot.draw("identify", "How far the row holds each parameter of each law", 1100, 760,
               script + "unset multiplot\n");
}

}  // namespace twinarm
