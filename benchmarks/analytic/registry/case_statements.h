// Statements of cases that are experiments of their own, by name. Many share one: an entry also
// stands for all cases whose names begin with it and a hyphen, and the longest such entry counts.
#pragma once

#include <string_view>
#include <vector>

namespace twinarm {

struct CaseStatement {
  std::string_view name;  // "E1-times", or "E1" for all of E1
  const char* text;       // one paragraph, formulas in <p>, HTML without a stylesheet
};

const std::vector<CaseStatement>& contact_statements();  // group E
const std::vector<CaseStatement>& other_statements();    // groups F, G, H

}  // namespace twinarm
