// The cases of integrators, group G.
#pragma once

#include <vector>

#include "benchmarks/analytic/support/analytic_case.h"

namespace twinarm::smooth_cases {

std::vector<AnalyticCase> integrators();  // G2, G3, G4

}  // namespace twinarm::smooth_cases
