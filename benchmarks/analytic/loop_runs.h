// The cases with closed loops, group D of docs/cases.md.
#pragma once

#include <vector>

#include "benchmarks/analytic/analytic_case.h"

namespace twinarm {

std::vector<AnalyticCase> loop_runs();

}  // namespace twinarm
