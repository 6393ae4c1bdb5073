#include "benchmarks/drivers/agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace twinarm::bench {
namespace {

using Answers = std::vector<std::vector<double>>;  // by situation

double relative_error(const Answers& mine, const Answers& reference) {
  double worst = 0;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    if (mine[k].size() != reference[k].size()) return std::numeric_limits<double>::infinity();
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < reference[k].size(); ++i) {
      const double d = std::abs(mine[k][i] - reference[k][i]);
      if (!std::isfinite(d)) return std::numeric_limits<double>::infinity();
      difference = std::max(difference, d);
      size = std::max(size, std::abs(reference[k][i]));
    }
    worst = std::max(worst, size > 0 ? difference / size : difference);
  }
  return worst;
}

// Entries of the revolutes alone.
std::vector<double> joints_of(const Scene& mechanism, const std::vector<double>& all) {
  return {all.begin() + (mechanism.floats() ? 6 : 0), all.end()};
}

}  // namespace

std::vector<Agreement> compare(Engines& engines, const Scene& mechanism,
                               const std::vector<Situation>& situations) {
  std::vector<Agreement> all;
  Answers first_qdd, first_tau;
  for (const auto& engine : engines) {
    Answers qdd, tau;
    for (std::size_t k = 0; k < situations.size(); ++k) {
      qdd.push_back(engine->qdd(k));
      if (engine->has(Algorithm::inverse_dynamics))
        tau.push_back(joints_of(mechanism, engine->tau(k)));
    }
    if (first_qdd.empty()) first_qdd = qdd, first_tau = tau;
    all.push_back({engine->name(), mechanism.name, relative_error(qdd, first_qdd),
                   tau.empty() ? 0 : relative_error(tau, first_tau), engine->tolerance(mechanism)});
  }
  return all;
}

}  // namespace twinarm::bench
