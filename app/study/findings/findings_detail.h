// Parts of findings.cpp: claims about one question each, and what they share.
#pragma once

#include "app/study/findings/predictions.h"
#include "app/study/findings/results.h"

namespace twinarm {

// findings_gains.cpp: what equal gains do, and which gains make the two couplings equal.
void add_equal_gains(const StudyInputs& inputs, const Predictions& predictions,
                     std::vector<Finding>& findings);
void add_matched_gains(const StudyResults& results, std::vector<Finding>& findings);

// findings_damping.cpp: signs and differences of the damping term, and the largest stable step.
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
