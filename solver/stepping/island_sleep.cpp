#include "solver/stepping/island_sleep.h"

#include <algorithm>
#include <cmath>

#include "solver/linear_algebra/nan_max.h"

namespace twinarm {

void IslandSleep::update(const Step& step) {
  const ImpulseProblem& problem = step.problem;
  quiet_.resize(static_cast<std::size_t>(problem.tree_count()));
  in_island_.assign(quiet_.size(), 0);
  const double max_change = std::max(step.accuracy, speed_ * step.h / kStart);
  for (const ImpulseIsland::Members& island : step.islands) {
    double speed = 0, change = 0;
    for (const int t : island.trees)
      for (int k = 0; k < problem.size(t); ++k) {
        const double v = problem.v(t)[k];
        speed = nan_max(speed, std::abs(v));
        change = nan_max(change,
                         std::abs(v - step.before[problem.first(t) + static_cast<std::size_t>(k)]));
      }
    const bool rests = speed <= speed_ && change <= max_change;
    for (const int t : island.trees) {
      double& quiet = quiet_[static_cast<std::size_t>(t)];
      quiet = rests ? std::min(kTime, quiet + step.h) : 0;
      in_island_[static_cast<std::size_t>(t)] = 1;
    }
  }
  for (std::size_t t = 0; t < quiet_.size(); ++t)
    if (!in_island_[t]) quiet_[t] = 0;
}

}  // namespace twinarm
