# Writes OUT, a .cpp with the text of FILES, named by their paths below ROOT, as string literals that the function
# FUNCTION lists (benchmarks/analytic/registry/case_sources.h).
set(all "")
foreach(file ${FILES})
  file(READ ${file} text)
  cmake_path(RELATIVE_PATH file BASE_DIRECTORY ${ROOT} OUTPUT_VARIABLE name)
  string(APPEND all "      {\"${name}\", R\"--text--(${text})--text--\"},\n")
endforeach()
file(WRITE ${OUT}.new "// Made by embed_sources.cmake.
#include \"benchmarks/analytic/registry/case_sources.h\"

namespace twinarm {

const std::vector<CaseSource>& ${FUNCTION}() {
  static const std::vector<CaseSource> all = {
${all}  };
  return all;
}

}  // namespace twinarm
")
file(RENAME ${OUT}.new ${OUT})
