// A run of `twinarm simulate`: steps on a grid, samples at any time, the ledger.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/simulate/ledger.h"
#include "app/simulate/simulate_input.h"
#include "app/simulate/simulate_options.h"
#include "solver/simulation.h"

namespace twinarm {

// Why a run stopped by itself.
struct PostMortem {
  double time = 0;  // of the last good state [s]
  long step = 0;    // the number of the bad one, from 1
  // The first bad quantity in the order of the passes, and the body in whose row it stands.
  std::string body, joint, field, reason;
  std::string fastest_joint;  // in the last good state: mostly the one that ran away
};

struct SimulateResult {
  long steps = 0;
  double end = 0;  // [s]; where the run stopped by itself: the last good time
  std::vector<LedgerRow> ledger;
  std::vector<LedgerRow> hand;  // of the kinematic sides of couplings; outside the sum
  std::vector<std::string> warnings;
  int contacts = 0;  // points that press, at the last step
  std::optional<PostMortem> post_mortem;
};

struct RunWatch {
  std::function<void(const std::string&)> warn;  // of the start, before the run; also in the result
  std::function<void(double t, const State<double>&)> sample;  // times of the plan, in their order
  std::function<void(double t)> tick;                          // after each step; may throw
};

// Samples between two points of the grid are reached by a side step from the earlier one; the run
// is the same, whatever is sampled.
SimulateResult run_plan(const SimulateInput& input, const RunPlan& plan, const RunWatch& watch);

}  // namespace twinarm
