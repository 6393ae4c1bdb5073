// The cases without contact, by what they are about: one file each, one line here each.
#pragma once

#include <vector>

#include "benchmarks/analytic/analytic_case.h"

namespace twinarm::smooth_cases {

std::vector<AnalyticCase> symmetric_body();  // A1

}  // namespace twinarm::smooth_cases
