// Runs selected analytic cases; table and JSON of their errors. The results do not depend on the
// order.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/analytic/registry/analytic_cases.h"
#include "benchmarks/analytic/support/trajectory_case.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

struct IntegrationRow {
  Integration integration;
  TrajectoryResult result;
  std::optional<double> order;
};
struct CompareRow {
  const AnalyticCase* test;
  CaseResult result;
  double seconds;
  std::vector<IntegrationRow> integrations;  // the requested ones, if the case allows any
};

struct CaseSelection {
  std::vector<const AnalyticCase*> cases;
  std::vector<const SkippedCase*> skipped;
};

// Cases of these names and of this group; all cases if both are empty. "E1" also selects "E1-..",
// "E" selects E1, E2 .., and a name may be a group's. Adds a diagnostic for each unknown name.
CaseSelection select_cases(const std::vector<std::string>& names, const std::string& group,
                           DiagnosticList& faults);

// Every integrator with every step (default: rk4, 1 ms); dopri5 once, with a tolerance of 1e-10.
// Adds a diagnostic for each unknown integrator and invalid step.
std::vector<Integration> read_integrations(const std::vector<std::string>& integrators,
                                           const std::vector<double>& steps,
                                           DiagnosticList& faults);
std::string integration_name(const Integration& integration);  // "rk4 0.001"

// A case passes or fails with its own integrator and step; the others are for comparison.
CompareRow run_one(const AnalyticCase& test, const std::vector<Integration>& integrations);

std::size_t failures(const std::vector<CompareRow>& rows);
// "12 passed, 1 failed", and ", 2 skipped" if any.
std::string totals(const std::vector<CompareRow>& rows, std::size_t skipped);

// A table and the failed cases; one JSON object. `page`: the file of --html, or empty.
std::string compare_table(const std::vector<CompareRow>& rows,
                          const std::vector<Integration>& integrations,
                          const std::vector<const SkippedCase*>& skipped);
std::string compare_json(const std::vector<CompareRow>& rows,
                         const std::vector<Integration>& integrations,
                         const std::vector<const SkippedCase*>& skipped, const std::string& page);

}  // namespace twinarm
