// What docs/cases/GROUP.md says of the cases, for people: a paragraph of what is known, below it
// the cases that measure it, as `- NAME, NAME: what is measured`.
#pragma once

#include <map>
#include <string>

namespace twinarm {

struct CaseText {
  std::string group, reference, statement;
};
const std::map<std::string, CaseText>& case_texts();  // by the name of the case

}  // namespace twinarm
