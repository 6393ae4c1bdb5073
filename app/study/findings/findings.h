// Every claim about the paper's numbers, derived again in this run (docs/understand/paper_analysis.md), and the
// answer to its question in five lines.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/study/findings/results.h"

namespace twinarm {

// Fills results.findings and results.rows; needs the runs.
void derive_findings(const StudyInputs& inputs, StudyResults& results, Progress& progress);
// Of both joints, to three digits: "1.23/4.56".
std::string words(const std::array<double, 2>& p);
// Needs the runs and the findings.
std::vector<std::string> answer_in_words(const StudyResults& results);

// Parts of findings.cpp: claims about one question each, and what they share.

// What was predicted before: assets/study/predictions.toml. Data, so that no number is in the code.
struct PredictedRow {
  std::string robot, law;
  double rate = 0;
  std::array<double, 2> max_deg{};
  std::optional<std::array<double, 2>> mean_deg;
};
struct PredictedModes {
  std::string robot;
  std::map<std::string, double> ratio;  // by law: world, joint, linear
};
struct Predictions {
  std::vector<PredictedRow> rows;
  std::vector<PredictedModes> modes;
};

// claims.cpp: what equal gains do, and which gains make the two couplings equal.
void add_equal_gains(const StudyInputs& inputs, const Predictions& predictions,
                     std::vector<Finding>& findings);
void add_matched_gains(const StudyResults& results, std::vector<Finding>& findings);

// Signs and differences of the damping term, and the largest stable step.
void add_damping(const StudyInputs& inputs, std::vector<Finding>& findings);
void add_differences(const StudyInputs& inputs, const StudyResults& results,
                     std::vector<Finding>& findings);
void add_stability(const StudyInputs& inputs, std::vector<Finding>& findings);

// findings.cpp
bool is_near(double measured, double predicted, double relative);
// A run on the automatic motion of a two-link robot, consistent unless the spec says otherwise.
RunResult run_automatic(const StudyRobot& robot, RunSpec spec, double k, double b, double rate);
const char* robot_words(const std::string& name);

}  // namespace twinarm
