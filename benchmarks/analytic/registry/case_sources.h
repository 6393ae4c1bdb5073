// The files of benchmarks/analytic/ as they were compiled, so that a page can show how a case is
// written, and those of docs/cases/, which say what each is. Made by embed_sources.cmake.
#pragma once

#include <string_view>
#include <vector>

namespace twinarm {

struct CaseSource {
  std::string_view file;  // "joints/pendulum.cpp", "joints.md"
  std::string_view text;
};
const std::vector<CaseSource>& case_sources();
const std::vector<CaseSource>& case_documents();

}  // namespace twinarm
