// Coupling laws of the identification, intervals of its profiles, and the searches.
#include <fmt/format.h>

#include <nlopt.hpp>

#include "app/study/calibration/calibration.h"

namespace twinarm {
namespace {

FamilyLaw consistent(const char* name, const char* words, CouplingSpec::Type type,
                     SpringSpace measure,
                     Discretization discretization = Discretization::explicit_) {
  FamilyLaw law{name, words, {}};
  law.coupling.name = name;
  law.coupling.type = type;
  law.coupling.measure = measure;
  law.coupling.discretization = discretization;
  return law;
}

struct Search {
  CalibrationEntry& entry;
  const std::function<double(const CalibrationEntry&)>& objective;
  std::vector<double> best;  // logarithms
  double best_value = HUGE_VAL;
  long evaluations = 0;
};

double evaluate(const std::vector<double>& x, std::vector<double>&, void* data) {
  auto& search = *static_cast<Search*>(data);
  check_interrupt();
  for (std::size_t i = 0; i < x.size(); ++i) search.entry.parameters[i].value = std::exp(x[i]);
  ++search.evaluations;
  const double value = search.objective(search.entry);
  if (value < search.best_value) {
    search.best_value = value;
    search.best = x;
  }
  return value;
}

// One optimisation from x; updates search.best.
void optimise(nlopt::opt& optimiser, const std::vector<double>& low,
              const std::vector<double>& high, int evaluations, Search& search,
              std::vector<double> x) {
  optimiser.set_lower_bounds(low);
  optimiser.set_upper_bounds(high);
  optimiser.set_min_objective(evaluate, &search);
  optimiser.set_maxeval(evaluations);
  optimiser.set_xtol_rel(1e-7);
  double value = 0;
  try {
    optimiser.optimize(x, value);
  } catch (const nlopt::roundoff_limited&) {
    // The simplex has shrunk to rounding: converged.
  } catch (const std::exception&) {
    check_interrupt();  // NLopt replaces exceptions of evaluate() by its own
    throw;
  }
}

}  // namespace

const std::vector<FamilyLaw>& family_laws() {
  using Type = CouplingSpec::Type;
  constexpr auto world = SpringSpace::world, joint = SpringSpace::joint;
  constexpr auto implicit = Discretization::implicit;
  static const std::vector<FamilyLaw> laws{
      {"printed-torsional", "torsional, as published", e3_spec("world-", 0).coupling},
      {"printed-linear", "linear, as published", e4_spec(0).coupling},
      consistent("torsional-world", "torsional, world orientation", Type::torsional, world),
      consistent("torsional-joint", "torsional, joint angle", Type::torsional, joint),
      consistent("linear", "linear", Type::linear, world),
      consistent("torsional-world-implicit", "torsional, world orientation, implicit",
                 Type::torsional, world, implicit),
      consistent("torsional-joint-implicit", "torsional, joint angle, implicit", Type::torsional,
                 joint, implicit),
      consistent("linear-implicit", "linear, implicit", Type::linear, world, implicit),
      consistent("matched", "torsional, full K_q of a linear coupling", Type::equivalent_torsional,
                 world),
      consistent("stable-pd", "stable PD at the joints", Type::stable_pd, joint),
      consistent("weld", "weld of the points, as in MuJoCo", Type::weld, world)};
  return laws;
}

const FamilyLaw& family_law(const std::string& name) {
  for (const FamilyLaw& law : family_laws())
    if (law.name == name) return law;
  throw std::out_of_range("unknown law " + name);
}

std::array<double, 4> table_misfits(const RunResult& result, const std::string& row) {
  std::array<double, 4> misfits;
  misfits.fill(1e5);
  if (!result.stable) return misfits;
  const PaperRow& paper = kPaperTable.at(row);
  for (std::size_t j = 0; j < 2; ++j) {
    misfits[j] = std::abs(result.max_deg[j] - paper.max_deg[j]) / paper.max_half_digit[j];
    misfits[2 + j] = std::abs(result.mean_deg[j] - paper.mean_deg[j]) / paper.mean_half_digit[j];
  }
  return misfits;
}

double Identification::threshold() const {
  return std::max(1.0, 2 * fit.objective);
}

Identification::Interval Identification::interval(const Profile& profile) const {
  const std::vector<ProfilePoint>& points = profile.points;
  const auto best = std::ranges::min_element(points, {}, &ProfilePoint::misfit);
  const auto end = [&](std::ptrdiff_t step, double& value, bool& open) {
    for (auto at = best;; at += step) {
      value = at->value;
      open = at == (step < 0 ? points.begin() : points.end() - 1);
      if (open) return;
      const ProfilePoint& next = at[step];
      if (next.misfit <= threshold()) continue;
      const double inside = std::log(std::max(at->misfit, 1e-12));
      const double share = (std::log(threshold()) - inside) / (std::log(next.misfit) - inside);
      value *= std::pow(next.value / value, std::clamp(share, 0.0, 1.0));
      return;
    }
  };
  Interval found;
  end(-1, found.low, found.open_low);
  end(1, found.high, found.open_high);
  return found;
}

std::string optimiser_name() {
  int major = 0, minor = 0, fix = 0;
  nlopt::version(major, minor, fix);
  return fmt::format(
      "NLopt {}.{}.{}: GN_CRS2_LM for the folded and the unsigned damper, G_MLSL_LDS with LN_SBPLX "
      "for the others; LN_SBPLX at the end of each",
      major, minor, fix);
}

void minimise(CalibrationEntry& entry, Method method, unsigned seed, int evaluations,
              const std::function<double(const CalibrationEntry&)>& objective) {
  nlopt::srand(seed);
  std::vector<double> low, high, middle;
  for (const Parameter& p : entry.parameters) {
    low.push_back(std::log(p.low));
    high.push_back(std::log(p.high));
    middle.push_back(0.5 * (low.back() + high.back()));
  }
  const auto n = static_cast<unsigned>(middle.size());
  Search search{entry, objective, middle, HUGE_VAL, 0};
  const int global = method == Method::local ? 0 : evaluations * 4 / 5;
  nlopt::opt local(nlopt::LN_SBPLX, n);
  if (method == Method::local) {
    for (std::size_t i = 0; i < n; ++i)
      search.best[i] = std::clamp(std::log(entry.parameters[i].value), low[i], high[i]);
    local.set_initial_step(0.1);
  } else if (method == Method::rugged) {
    nlopt::opt crs(nlopt::GN_CRS2_LM, n);
    crs.set_population(40 * n);
    optimise(crs, low, high, global, search, middle);
    local.set_initial_step(0.02);
  } else {
    nlopt::opt mlsl(nlopt::G_MLSL_LDS, n);
    nlopt::opt inner(nlopt::LN_SBPLX, n);
    inner.set_xtol_rel(1e-4);
    inner.set_ftol_rel(1e-4);
    inner.set_maxeval(150);
    mlsl.set_local_optimizer(inner);
    mlsl.set_population(8 * n);
    optimise(mlsl, low, high, global, search, middle);
    local.set_initial_step(0.05);
  }
  optimise(local, low, high, evaluations - global, search, search.best);
  for (std::size_t i = 0; i < n; ++i) entry.parameters[i].value = std::exp(search.best[i]);
  entry.objective = search.best_value;
  entry.evaluations = search.evaluations;
}

}  // namespace twinarm
