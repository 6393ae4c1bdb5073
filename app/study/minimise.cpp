#include <fmt/format.h>

#include <cmath>
#include <nlopt.hpp>

#include "app/interrupt.h"
#include "app/study/calibration.h"

namespace twinarm {
namespace {

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

}  // namespace

std::string optimiser_name() {
  int major = 0, minor = 0, fix = 0;
  nlopt::version(major, minor, fix);
  return fmt::format("NLopt {}.{}.{}: GN_CRS2_LM, then LN_SBPLX", major, minor, fix);
}

void minimise(CalibrationEntry& entry, unsigned seed, int evaluations,
              const std::function<double(const CalibrationEntry&)>& objective) {
  nlopt::srand(seed);
  std::vector<double> low, high;
  for (const Parameter& p : entry.parameters) {
    low.push_back(std::log(p.low));
    high.push_back(std::log(p.high));
  }
  Search search{entry, objective, {}, HUGE_VAL, 0};
  std::vector<double> x(low.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = 0.5 * (low[i] + high[i]);
  for (const auto& [algorithm, share] :
       {std::pair{nlopt::GN_CRS2_LM, 0.8}, {nlopt::LN_SBPLX, 0.2}}) {
    nlopt::opt optimiser(algorithm, static_cast<unsigned>(x.size()));
    optimiser.set_lower_bounds(low);
    optimiser.set_upper_bounds(high);
    optimiser.set_min_objective(evaluate, &search);
    optimiser.set_maxeval(static_cast<int>(share * evaluations));
    optimiser.set_xtol_rel(1e-6);
    if (algorithm == nlopt::LN_SBPLX) optimiser.set_initial_step(0.05);
    double value = 0;
    try {
      optimiser.optimize(x, value);
    } catch (const nlopt::roundoff_limited&) {
      // The simplex has shrunk to nothing: as good as it gets.
    } catch (const nlopt::forced_stop&) {
      check_interrupt();  // NLopt turns what evaluate() throws into this
      throw;
    }
    x = search.best;
  }
  for (std::size_t i = 0; i < x.size(); ++i) entry.parameters[i].value = std::exp(search.best[i]);
  entry.objective = search.best_value;
  entry.evaluations = search.evaluations;
}

}  // namespace twinarm
