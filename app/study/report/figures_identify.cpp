// Figure of the identification from Table 2: intervals of all parameters, by law.

#include <set>

#include "app/study/report/report_slots.h"

namespace twinarm {
namespace {

constexpr double kMaxFactor = 12;  // of the axis

const std::vector<std::string> kNames{"k1", "b1", "k2", "b2", "mass of arm 2"};
const std::vector<std::string> kKeys{"k1", "b1", "k2", "b2", "arm2_mass_scale"};

// Intervals relative to the best value: of fits that agree with the row in colour, behind them the
// others.
std::string interval_plots(Gnuplot& gnuplot, const std::vector<Identification>& all,
                           const std::set<double>& rates, const std::string& row,
                           const std::string& key, const char* colour) {
  const std::vector<FamilyLaw>& laws = family_laws();
  const double rows = static_cast<double>(laws.size()), count = static_cast<double>(rates.size());
  std::string plots;
  for (const bool agrees : {false, true}) {
    std::vector<double> y, low, length;
    for (const Identification& found : all) {
      if (found.row != row || (found.fit.objective <= 1) != agrees) continue;
      const auto profile = std::ranges::find(found.profiles, key, &Profile::parameter);
      if (profile == found.profiles.end()) continue;
      const auto law =
          static_cast<double>(std::ranges::find(laws, found.law, &FamilyLaw::name) - laws.begin());
      const auto rate =
          static_cast<double>(std::distance(rates.begin(), rates.find(found.fit.rate)));
      const Identification::Interval in = found.interval(*profile);
      const double best = found.fit.value(key);
      y.push_back(rows - 1 - law + 1 / (count + 1) * ((count - 1) / 2 - rate));
      low.push_back(in.open_low ? 1 / kMaxFactor : in.low / best);
      length.push_back((in.open_high ? kMaxFactor : in.high / best) - low.back());
    }
    if (y.empty()) continue;
    plots += fmt::format("{}{} using 2:1:3:(0) with vectors nohead lw {} lc '{}'",
                         plots.empty() ? "plot " : ", ", gnuplot.data({y, low, length}),
                         agrees ? 5 : 2, agrees ? colour : palette::faint);
  }
  return plots.empty() ? "" : plots + "\n";
}

}  // namespace

void draw_identification(Gnuplot& gnuplot, const StudyResults& results) {
  const std::vector<Identification>& all = results.identifications;
  if (all.empty()) return;
  constexpr const char* kColours[] = {palette::torsional, palette::linear};
  std::set<double> rates;
  for (const Identification& found : all) rates.insert(found.fit.rate);
  const std::vector<FamilyLaw>& laws = family_laws();
  const double rows = static_cast<double>(laws.size());
  std::string tics;
  for (std::size_t l = 0; l < laws.size(); ++l)
    tics += fmt::format("{}{} {}", l == 0 ? "" : ", ", in_quotes(laws[l].words),
                        rows - 1 - static_cast<double>(l));
  std::string script = fmt::format(
      "set multiplot\nset tics scale 0.5\nset logscale x\nset xrange [{}:{}]\n"
      "set yrange [-0.6:{}]\nset xtics ('1/5' 0.2, '1' 1, '5' 5)\nunset key\nset grid x\n",
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
          std::string(row) + ", " + kNames[p]);
      script += interval_plots(gnuplot, all, rates, row, kKeys[p], kColours[r]);
    }
  }
  gnuplot.draw("identify", "Intervals of the parameters of each law that agree with the row", 1100,
               760, script + "unset multiplot\n");
}

}  // namespace twinarm
