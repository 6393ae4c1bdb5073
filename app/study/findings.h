// Every claim about the paper's numbers, derived again in this run (docs/findings.md), and the
// answer to its question in five lines.
#pragma once

#include "app/study/results.h"

namespace twinarm {

// Fills results.findings and results.rows; needs the runs.
void derive_findings(const StudyInputs& inputs, StudyResults& results, Progress& progress);
// Needs the runs and the findings.
std::vector<std::string> answer_in_words(const StudyResults& results);

}  // namespace twinarm
