// Where a case is written, of the files as they were compiled.
#pragma once

#include <string>
#include <vector>

namespace twinarm::compare_page {

struct CasePlace {
  std::string file;  // "joints/pendulum.cpp", of benchmarks/analytic/; empty: not found
  std::size_t line = 0;
};
CasePlace place_of(const std::string& case_name);

// A link to it, and what it leads to: each file once, whole, to be unfolded.
std::string link_to_code(const std::string& case_name);
std::string code_of(const std::vector<std::string>& case_names);

}  // namespace twinarm::compare_page
