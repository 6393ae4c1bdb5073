// Every claim about the paper's numbers, derived again in this run (docs/findings.md), and the
// answer to its question in five lines.
#pragma once

#include <array>
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

}  // namespace twinarm
