// All analytic cases, and how one is run and judged.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "benchmarks/analytic/support/analytic_case.h"
#include "solver/support/embedded_file.h"

namespace twinarm {

// All of them, in the order of docs/reference/verification_cases.md. Names are unique.
const std::vector<AnalyticCase>& analytic_cases();

// What docs/reference/cases/GROUP.md says of the cases, for people: a paragraph of what is known, below it
// the cases that measure it, as `- NAME, NAME: what is measured`.
struct CaseText {
  std::string group, reference, statement;
};
const std::map<std::string, CaseText>& case_texts();  // by the name of the case

// The files of benchmarks/analytic/ as they were compiled, so that a page can show how a case is
// written.
const std::vector<EmbeddedFile>& case_sources();

// What is not run, and why: listed, never counted as passed.
struct SkippedCase {
  const char *name, *group, *why;
};
const std::vector<SkippedCase>& skipped_cases();

// The case as it is judged: a trajectory in its own lane, and with its order of convergence.
CaseResult run_case(const AnalyticCase& c);

}  // namespace twinarm
