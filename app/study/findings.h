// Every claim about the paper's numbers, derived again in this run (docs/findings.md), and the
// answer to its question in five lines.
#pragma once

#include "app/study/results.h"

namespace twinarm {

std::vector<Finding> derive_findings(const StudyInputs& inputs, const StudyResults& results,
                                     Progress& progress);
// Needs everything else of the results.
std::vector<std::string> answer_in_words(const StudyResults& results);

}  // namespace twinarm
