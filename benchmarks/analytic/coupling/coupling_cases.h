// The cases of couplings, group F.
#pragma once

#include <vector>

#include "benchmarks/analytic/support/analytic_case.h"

namespace twinarm::smooth_cases {

std::vector<AnalyticCase> coupling_tracking();   // F3
std::vector<AnalyticCase> coupling_stability();  // F4

}  // namespace twinarm::smooth_cases
