#include "benchmarks/analytic/registry/analytic_cases.h"

#include <algorithm>

#include "benchmarks/analytic/registry/case_texts.h"
#include "benchmarks/analytic/support/run_trajectory.h"

namespace twinarm {

const std::vector<AnalyticCase>& analytic_cases() {
  static const std::vector<AnalyticCase> all = [] {
    std::vector<CaseFamily> families;
    for (const auto* folder :
         {&joint_cases(), &loop_cases(), &contact_cases(), &coupling_cases(), &integrator_cases()})
      families.insert(families.end(), folder->begin(), folder->end());
    std::stable_sort(families.begin(), families.end(),
                     [](const CaseFamily& a, const CaseFamily& b) { return a.order < b.order; });
    std::vector<AnalyticCase> cases;
    for (const CaseFamily& family : families)
      cases.insert(cases.end(), family.cases.begin(), family.cases.end());
    for (AnalyticCase& c : cases)
      if (const auto text = case_texts().find(c.name); text != case_texts().end()) {
        c.group = text->second.group.c_str();
        c.reference = text->second.reference.c_str();
        c.statement = text->second.statement.c_str();
      }
    return cases;
  }();
  return all;
}

const std::vector<SkippedCase>& skipped_cases() {
  static const std::vector<SkippedCase> all = {
      {"D8", "loops",
       "the rectangular Bricard: neither its data nor reference values are published; see D4"},
      {"E14-capstan", "contact", "optional: friction of a belt needs a rope of many contacts"},
      {"E15", "contact", "optional: a silo needs many thousand grains"},
      {"F5", "robots",
       "the iiwa's parameters are those of a URDF that is not part of this program"},
      {"H1-anymal", "engines", "the model of the robot is not part of this program"},
      {"H2", "engines", "the models of hand and humanoid are not published with the numbers"},
      {"H3", "engines", "a list of what other engines test, not a case"},
  };
  return all;
}

CaseResult run_case(const AnalyticCase& c) {
  if (!c.trajectory) return c.run();
  const LaneResult result = run_lane(*c.trajectory, c.trajectory->lane);
  return {result.error, result.energy_drift, observed_order(*c.trajectory, c.trajectory->lane)};
}

}  // namespace twinarm
