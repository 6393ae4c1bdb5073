// Claims about the paper's numbers, checked again in this run (docs/understand/paper_analysis.md),
// and the answer to its question.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/data/value.h"
#include "app/study/findings/results.h"

namespace twinarm {

// Fills results.findings and results.rows; requires the runs.
void derive_findings(const StudyInputs& inputs, StudyResults& results, Progress& progress);
// Numbers of both joints, three digits: "1.23/4.56".
std::string words(const std::array<double, 2>& p);
// The answer in one sentence, then the others, each with its conclusion in its first sentence.
// Requires the runs and the findings.
std::vector<std::string> answer_in_words(const StudyResults& results);

// ---- parts of findings.cpp ----

// An entry of assets/study/predictions.toml, made before the run. Throws InputError if it is
// missing.
const Value& entry_of(const Value& predictions, const char* key);

// claims.cpp: equal gains, and gains for which the two couplings are equivalent.
void add_equal_gains(const StudyInputs& inputs, const Value& predictions,
                     std::vector<Finding>& findings);
void add_matched_gains(const StudyResults& results, std::vector<Finding>& findings);
// Maxima within 0.1 degree or 10 % of the linear coupling's.
bool have_equal_errors(const RunResult& linear, const RunResult& torsional);

// Signs and differences of the damping term, and the largest stable step.
void add_damping(const StudyInputs& inputs, std::vector<Finding>& findings);
void add_differences(const StudyInputs& inputs, const StudyResults& results,
                     std::vector<Finding>& findings);
void add_stability(const StudyInputs& inputs, std::vector<Finding>& findings);

// findings.cpp
bool is_near(double measured, double predicted, double relative);
// Automatic motion of a two-link robot with one k and b.
RunResult run_automatic(const StudyRobot& robot, RunSpec spec, double k, double b, double rate);
inline constexpr const char* kTwoLinkRobots[] = {"findings_set0", "findings_10_14"};
// Of "ROBOT/LAW/RATE" and the like: what its parts mean, "linear, as published".
std::string run_words(const std::string& name);

}  // namespace twinarm
