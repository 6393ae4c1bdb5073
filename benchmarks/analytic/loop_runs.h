// The cases with closed loops, group D of docs/cases.md.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "benchmarks/analytic/analytic_case.h"

namespace twinarm {

std::vector<AnalyticCase> loop_runs();

// The mechanism of a case of that list as a motion to look at, in the lane in which it is judged;
// null for others.
std::shared_ptr<const TrajectoryCase> loop_motion(std::string_view case_name);

}  // namespace twinarm
