// The laws that are asked for, and how an answer is read.
#include <algorithm>
#include <cmath>

#include "app/study/calibration/identify.h"

namespace twinarm {
namespace {

FamilyLaw consistent(const char* name, const char* words, CouplingSpec::Type type, Measure measure,
                     Treatment treatment) {
  FamilyLaw law{name, words, {}};
  law.coupling.name = name;
  law.coupling.type = type;
  law.coupling.measure = measure;
  law.coupling.treatment = treatment;
  return law;
}

}  // namespace

const std::vector<FamilyLaw>& family_laws() {
  using Type = CouplingSpec::Type;
  static const std::vector<FamilyLaw> laws = [] {
    std::vector<FamilyLaw> all{
        {"printed-torsional", "torsional, as printed", e3_spec("world-", 0).coupling},
        {"printed-linear", "linear, as printed", e4_spec(0).coupling},
        consistent("torsional-world", "torsional, world orientation", Type::torsional,
                   Measure::world, Treatment::explicit_),
        consistent("torsional-joint", "torsional, joint angle", Type::torsional, Measure::joint,
                   Treatment::explicit_),
        consistent("linear", "linear", Type::linear, Measure::world, Treatment::explicit_),
        consistent("torsional-world-implicit", "torsional, world orientation, implicit",
                   Type::torsional, Measure::world, Treatment::implicit),
        consistent("torsional-joint-implicit", "torsional, joint angle, implicit", Type::torsional,
                   Measure::joint, Treatment::implicit),
        consistent("linear-implicit", "linear, implicit", Type::linear, Measure::world,
                   Treatment::implicit),
        consistent("matched", "torsional, full K_q of a linear one", Type::matched, Measure::world,
                   Treatment::explicit_),
        consistent("stable-pd", "stable PD at the joints", Type::stable_pd, Measure::joint,
                   Treatment::explicit_),
        consistent("weld", "weld of the points, as MuJoCo's", Type::weld_like, Measure::world,
                   Treatment::explicit_)};
    return all;
  }();
  return laws;
}

const FamilyLaw& family_law(const std::string& name) {
  for (const FamilyLaw& law : family_laws())
    if (law.name == name) return law;
  throw std::out_of_range("no law " + name);
}

double table_misfit(const RunResult& result, const PaperRow& row) {
  if (!result.stable) return 1e5;
  double worst = 0;
  for (std::size_t j = 0; j < 2; ++j)
    worst = std::max({worst, std::abs(result.max_deg[j] - row.max_deg[j]) / kHalfDigit,
                      std::abs(result.mean_deg[j] - row.mean_deg[j]) / kHalfDigit});
  return worst;
}

double Identification::allowance() const {
  return std::max(1.0, 2 * fit.objective);
}

Identification::Interval Identification::interval(const Profile& profile) const {
  const std::vector<ProfilePoint>& points = profile.points;
  const auto best = static_cast<std::size_t>(
      std::min_element(points.begin(), points.end(),
                       [](const auto& a, const auto& b) { return a.misfit < b.misfit; }) -
      points.begin());
  const auto end = [&](int step, double& value, bool& open) {
    std::size_t i = best;
    for (;; i = static_cast<std::size_t>(static_cast<int>(i) + step)) {
      open = step < 0 ? i == 0 : i + 1 == points.size();
      value = points[i].value;
      if (open) return;
      const ProfilePoint& next = points[static_cast<std::size_t>(static_cast<int>(i) + step)];
      if (next.misfit <= allowance()) continue;
      const double inside = std::log(std::max(points[i].misfit, 1e-12));
      const double share = (std::log(allowance()) - inside) / (std::log(next.misfit) - inside);
      value *= std::pow(next.value / value, std::clamp(share, 0.0, 1.0));
      return;
    }
  };
  Interval found;
  end(-1, found.low, found.open_low);
  end(1, found.high, found.open_high);
  return found;
}

}  // namespace twinarm
