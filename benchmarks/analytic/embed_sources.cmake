# Writes OUT, a .cpp with the text of FILES as string literals (benchmarks/analytic/case_sources.h).
set(all "")
foreach(file ${FILES})
  file(READ ${file} text)
  cmake_path(GET file FILENAME name)
  string(APPEND all "      {\"${name}\", R\"--text--(${text})--text--\"},\n")
endforeach()
file(WRITE ${OUT}.new "// Made by embed_sources.cmake.
#include \"benchmarks/analytic/case_sources.h\"

namespace twinarm {

const std::vector<CaseSource>& case_sources() {
  static const std::vector<CaseSource> all = {
${all}  };
  return all;
}

}  // namespace twinarm
")
file(RENAME ${OUT}.new ${OUT})
