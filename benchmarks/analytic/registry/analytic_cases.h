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

// What is known, for people: one paragraph, formulas in <p>, HTML without a stylesheet. That of the
// trajectory, of the case itself, or of case_statements.cpp; null where there is none.
const char* statement_of(const AnalyticCase& c);

}  // namespace twinarm
