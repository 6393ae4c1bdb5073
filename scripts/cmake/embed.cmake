# Files as they are, in the program.
#
# twinarm_embed(FUNCTION ROOT PATTERN) adds to the library of this folder a made file that defines
# `const std::vector<EmbeddedFile>& FUNCTION()` (solver/support/embedded_file.h): the files of ROOT that match
# PATTERN, named by their paths below it. Called after twinarm_library().
if(CMAKE_SCRIPT_MODE_FILE)  # how the made file is written
  set(all "")
  foreach(file ${FILES})
    file(READ ${file} text)
    cmake_path(RELATIVE_PATH file BASE_DIRECTORY ${ROOT} OUTPUT_VARIABLE name)
    string(APPEND all "      {\"${name}\", R\"--text--(${text})--text--\"},\n")
  endforeach()
  file(WRITE ${OUT}.new "// Made by embed.cmake.
#include \"solver/support/embedded_file.h\"

namespace twinarm {

const std::vector<EmbeddedFile>& ${FUNCTION}() {
  static const std::vector<EmbeddedFile> all = {
${all}  };
  return all;
}

}  // namespace twinarm
")
  file(RENAME ${OUT}.new ${OUT})
  return()
endif()

set(TWINARM_EMBED ${CMAKE_CURRENT_LIST_FILE})
function(twinarm_embed FUNCTION ROOT PATTERN)
  file(GLOB files CONFIGURE_DEPENDS ${ROOT}/${PATTERN})
  set(made ${CMAKE_CURRENT_BINARY_DIR}/${FUNCTION}.cpp)
  add_custom_command(OUTPUT ${made}
    COMMAND ${CMAKE_COMMAND} "-DFILES=${files}" -DROOT=${ROOT} -DOUT=${made} -DFUNCTION=${FUNCTION} -P ${TWINARM_EMBED}
    DEPENDS ${files} ${TWINARM_EMBED}
    VERBATIM)
  file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  string(REPLACE / _ name twinarm_${folder})
  target_sources(${name} PRIVATE ${made})
endfunction()
