// The analytic cases that were asked for, each run by itself, so that their order
// changes no bit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/analytic/registry/analytic_cases.h"
#include "benchmarks/analytic/support/trajectory_case.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

struct IntegrationRow {
  Lane integration;
  TrajectoryResult result;
  std::optional<double> order;
};
struct CompareRow {
  const AnalyticCase* test;
  CaseResult result;
  double seconds;
  std::vector<IntegrationRow> integrations;  // those that were asked for; none for a case that takes none
};

struct CaseSelection {
  std::vector<const AnalyticCase*> cases;
  std::vector<const SkippedCase*> skipped;
};

// Those of these names, and all of the group (empty: none); all there are where both are empty.
// "E1" also stands for all that begin with "E1-", "E" for E1, E2 .., and a name may be a group's.
// All names that nothing has are faults.
CaseSelection select_cases(const std::vector<std::string>& names, const std::string& group,
                           DiagnosticList& faults);

// Every integrator with every step; rk4 and 1 ms where only one of them is given; dopri5 once, with
// a tolerance of 1e-10. All that are no integrators or steps are faults.
std::vector<Lane> read_lanes(const std::vector<std::string>& integrators,
                             const std::vector<double>& steps, DiagnosticList& faults);
std::string integration_name(const Lane& integration);  // "rk4 0.001"

// A case is judged in its own integration; the others are beside it.
CompareRow run_one(const AnalyticCase& test, const std::vector<Lane>& integrations);

// How many fell short.
std::size_t failures(const std::vector<CompareRow>& rows);

// For people: a table, and what fell short below it. For programs: one JSON object;
// `page` is the file that --html made, or empty.
std::string compare_table(const std::vector<CompareRow>& rows, const std::vector<Lane>& integrations,
                          const std::vector<const SkippedCase*>& skipped);
std::string compare_json(const std::vector<CompareRow>& rows, const std::vector<Lane>& integrations,
                         const std::vector<const SkippedCase*>& skipped, const std::string& page);

}  // namespace twinarm
