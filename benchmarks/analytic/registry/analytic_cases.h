// All analytic cases, and how one is run and judged.
#pragma once

#include <vector>

#include "benchmarks/analytic/support/analytic_case.h"

namespace twinarm {

// All of them, in the order of docs/cases.md. Names are unique.
const std::vector<AnalyticCase>& analytic_cases();

// What is not run, and why: listed, never counted as passed.
struct SkippedCase {
  const char *name, *group, *why;
};
const std::vector<SkippedCase>& skipped_cases();

// The case as it is judged: a trajectory in its own lane, and with its order of convergence.
CaseResult run_case(const AnalyticCase& c);

}  // namespace twinarm
