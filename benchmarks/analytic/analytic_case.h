// Cases whose outcome is known, as one list: the test loops over it, `twinarm compare` shows it.
//
// Each case runs this project's solver and measures ONE number, its error, in the unit of its
// tolerance. References are closed forms or come from computations in extended precision that share
// nothing with the solver (docs/cases.md).
#pragma once

#include <optional>
#include <vector>

namespace twinarm {

struct CaseResult {
  double error = 0;  // not a number fails
  // max |E - E0| over the largest kinetic energy; nothing where forces are meant to change E.
  std::optional<double> energy_drift{};
  std::optional<double> order{};  // of convergence, where it is measured
};

struct AnalyticCase {
  const char* name;       // "E1-times"
  const char* group;      // "contact", "loops"
  const char* reference;  // what is measured, with its unit, against what
  double tolerance;       // the case passes where error <= tolerance; 0: nothing may be broken
  CaseResult (*run)();
};

inline bool passes(const AnalyticCase& c, const CaseResult& result) {
  return result.error <= c.tolerance;
}

// All of them, in the order of docs/cases.md. Names are unique.
const std::vector<AnalyticCase>& analytic_cases();

}  // namespace twinarm
