// The study as one JSON object, for programs (the contract: docs/command_line.md).
#pragma once

#include <string>

#include "app/study/findings/results.h"

namespace twinarm {

// {"runs": {"E1": {"max_deg": {"joint1", "joint2"}, "mean_deg", "paper", "gains", "step", ...}},
//  "variants": [..], "findings": [..], "obstacle": [..], "answer": [..], "report": PATH, ...}.
// Lengths in m, times in s, rates in Hz; angles in degrees where the key says so. What is not
// finite is null.
std::string study_json(const StudyResults& results, const std::string& report_path);

// One answer of `--ask`, with its profiles and directions.
std::string answer_json(const Identification& found);

}  // namespace twinarm
