// Cases whose outcome is known, as one list: the test loops over it, `twinarm compare` shows it.
//
// Each case measures ONE number with this project's solver, its error, in the unit of its
// tolerance. References are closed forms or come from computations in extended precision that share
// nothing with the solver (docs/reference/verification_cases.md). Two kinds: a motion that is known (trajectory), which
// any integrator can be tried on; and all else, an experiment of its own (run).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "benchmarks/analytic/support/trajectory_case.h"

namespace twinarm {

struct CaseResult {
  double error = 0;  // not a number fails
  // max |E - E0| over the largest kinetic energy; nothing where forces are meant to change E.
  std::optional<double> energy_drift{};
  std::optional<double> order{};  // of convergence, where it is measured
};

struct ContactCasePlot;

struct AnalyticCase {
  const char* name;  // "E1-times"
  double tolerance;  // the case passes where error <= tolerance; 0: nothing may be broken
  std::function<CaseResult()> run{};       // null: a trajectory
  std::function<CaseResult()> mistaken{};  // run() with a mistake in it, which must fail
  std::shared_ptr<const TrajectoryCase> trajectory{};
  std::shared_ptr<const ContactCasePlot> look{};  // what a page draws; null: nothing
  // Of the list, from docs/reference/cases/: "contact"; what is measured, with its unit, against what; and
  // what is known, for people: one paragraph, formulas in <p>, HTML without a stylesheet.
  const char *group = "", *reference = "", *statement = "";

  AnalyticCase(const char* its_name, double its_tolerance, TrajectoryCase motion)
      : name(its_name),
        tolerance(its_tolerance),
        trajectory(std::make_shared<const TrajectoryCase>(std::move(motion))) {}
  AnalyticCase(const char* its_name, double its_tolerance,
               const std::function<CaseResult(bool mistaken)>& experiment)
      : name(its_name),
        tolerance(its_tolerance),
        run([experiment] { return experiment(false); }),
        mistaken([experiment] { return experiment(true); }) {}
};

// The cases of one file, and their place among the families: they are shown in ascending order.
struct CaseFamily {
  int order;
  std::vector<AnalyticCase> cases;
};

// Those of each folder, made by twinarm_registry(): a file NAME.cpp defines `CaseFamily
// NAME_cases()`.
const std::vector<CaseFamily>& joint_cases();       // groups A, B, C, F1, F2, G1 of docs/reference/verification_cases.md
const std::vector<CaseFamily>& loop_cases();        // D
const std::vector<CaseFamily>& contact_cases();     // E, H1
const std::vector<CaseFamily>& coupling_cases();    // F3, F4
const std::vector<CaseFamily>& integrator_cases();  // G2 to G4

inline bool passes(const AnalyticCase& c, const CaseResult& result) {
  return result.error <= c.tolerance;
}

// What nearly every case needs.
inline constexpr double kGravity = 9.81;  // [m/s^2]

}  // namespace twinarm
