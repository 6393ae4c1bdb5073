// How a case is written: the parts of its file that it is made of, and nothing else.
//
// Files of benchmarks/analytic/ are formatted alike, so that a definition begins where a line
// begins in the first column. From the line that registers the case all definitions are followed
// by name.
#pragma once

#include <string>

namespace twinarm::compare_page {

struct CaseCode {
  std::string file;  // "benchmarks/analytic/joints/pendulum.cpp"; empty where the case is not found
  std::string text;
};
CaseCode code_of(const std::string& case_name);

}  // namespace twinarm::compare_page
