// List of all analytic cases.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "benchmarks/analytic/support/analytic_case.h"
#include "solver/support/embedded_file.h"

namespace twinarm {

// In the order of docs/reference/verification_cases.md. Names are unique.
const std::vector<AnalyticCase>& analytic_cases();

const std::map<std::string, CaseText>& case_texts();  // by the name of the case

// Source text of benchmarks/analytic/, which the page of `twinarm compare` shows.
const std::vector<EmbeddedFile>& case_sources();

// Cases that are not run, and the reason.
struct SkippedCase {
  const char *name, *group, *why;
};
const std::vector<SkippedCase>& skipped_cases();

// Runs a case; a trajectory with its own integrator and step, and its order of convergence.
CaseResult run_case(const AnalyticCase& c);

}  // namespace twinarm
