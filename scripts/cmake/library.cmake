# A folder is a library is a layer.
#
# twinarm_library([USES FOLDER ..] [LIBRARIES TARGET ..] [SPEED hard|normal|fast] [ALONE FILE ..])
# makes the library of this folder: all its .cpp files, named after its path (solver/dynamics is
# twinarm_solver_dynamics). USES: folders whose headers it includes, by path. LIBRARIES: what is not
# ours. SPEED: how hard the compiler tries (below). ALONE: files whose headers bring macros or take
# long to read, compiled as units of their own. The layers are written to build/.../layers.txt, from
# which tests/lint derives the includes that are allowed.
function(twinarm_library)
  cmake_parse_arguments(L "" "SPEED" "USES;LIBRARIES;ALONE" ${ARGN})
  twinarm_layer(name uses USES ${L_USES} LIBRARIES ${L_LIBRARIES})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  if(NOT sources)  # headers alone
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ${uses} ${L_LIBRARIES})
    return()
  endif()
  add_library(${name} STATIC ${sources})
  # Our warnings and flags are for our own build, not for users of the installed libraries.
  target_link_libraries(${name}
    PUBLIC $<BUILD_INTERFACE:twinarm_flags> Eigen3::Eigen ${uses} PRIVATE ${L_LIBRARIES})
  set_source_files_properties(${L_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  if(L_SPEED STREQUAL "hard")
    twinarm_compile_hard(${name})
  elseif(L_SPEED STREQUAL "fast")
    twinarm_compile_fast(${name})
  endif()
  twinarm_share_headers(${name} "${L_SPEED}")
endfunction()

# The library of this folder where its objects are compiled several times (kernels.cmake), or made.
function(twinarm_library_of_objects)
  cmake_parse_arguments(L "" "" "USES;OBJECTS" ${ARGN})
  twinarm_layer(name uses USES ${L_USES})
  add_library(${name} STATIC ${L_OBJECTS})
  set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(${name} PUBLIC $<BUILD_INTERFACE:twinarm_flags> Eigen3::Eigen ${uses})
endfunction()

# twinarm_registry(HEADER FILE TYPE TYPE FUNCTION NAME SUFFIX TEXT [NAMESPACE twinarm] [ORDER MEMBER] [FILES GLOB ..])
# One file, one entry: each file of this folder that matches FILES (*.cpp) defines `TYPE STEM_SUFFIX()`,
# and the made function `const std::vector<TYPE>& NAME()`, declared in HEADER, lists them by their member
# ORDER, else by the names of the files. So a new file of the folder is registered by being there. Called
# after twinarm_library().
function(twinarm_registry)
  cmake_parse_arguments(R "" "HEADER;TYPE;FUNCTION;SUFFIX;NAMESPACE;ORDER" "FILES" ${ARGN})
  if(NOT R_FILES)
    set(R_FILES *.cpp)
  endif()
  if(NOT R_NAMESPACE)
    set(R_NAMESPACE twinarm)
  endif()
  file(GLOB files CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} ${R_FILES})
  list(SORT files)
  set(declarations "")
  set(calls "")
  foreach(file ${files})
    string(REGEX REPLACE "\\.cpp$" "" stem ${file})
    string(APPEND declarations "${R_TYPE} ${stem}${R_SUFFIX}();\n")
    string(APPEND calls "${stem}${R_SUFFIX}(), ")
  endforeach()
  set(order "")
  if(R_ORDER)
    set(order "std::ranges::sort(found, {}, &${R_TYPE}::${R_ORDER});\n    ")
  endif()
  set(made ${CMAKE_CURRENT_BINARY_DIR}/${R_FUNCTION}.cpp)
  file(CONFIGURE OUTPUT ${made} CONTENT "// Made by twinarm_registry() from the files of a folder.
#include \"${R_HEADER}\"

#include <algorithm>

namespace ${R_NAMESPACE} {

${declarations}
const std::vector<${R_TYPE}>& ${R_FUNCTION}() {
  static const std::vector<${R_TYPE}> all = [] {
    std::vector<${R_TYPE}> found{${calls}};
    ${order}return found;
  }();
  return all;
}

}  // namespace ${R_NAMESPACE}
")
  file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  string(REPLACE / _ name twinarm_${folder})
  target_sources(${name} PRIVATE ${made})
endfunction()

# Lists this folder among the layers. NAME and LINKED are set to its target and those of USES.
function(twinarm_layer NAME LINKED)
  cmake_parse_arguments(L "" "" "USES;LIBRARIES" ${ARGN})
  file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  string(REPLACE / _ name twinarm_${folder})
  list(TRANSFORM L_USES REPLACE / _)
  list(TRANSFORM L_USES PREPEND twinarm_)
  list(JOIN L_USES " " uses)
  list(JOIN L_LIBRARIES " " libraries)
  set_property(GLOBAL APPEND PROPERTY TWINARM_LAYERS "${folder}: ${uses} ${libraries}")
  set(${NAME} ${name} PARENT_SCOPE)
  set(${LINKED} ${L_USES} PARENT_SCOPE)
endfunction()

# For what runs for moments: less optimised, a target takes a quarter less to compile. The bits stay.
function(twinarm_compile_fast target)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()
# For what every step runs: calls of Eigen's small products are inlined, a tenth of a servo tick. The
# bits stay. g++ 12 then warns of std::string's copies, wrongly (PR 105651, 105329).
function(twinarm_compile_hard target)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${target} PRIVATE
      -O3 $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-stringop-overflow;-Wno-array-bounds>)
  endif()
endfunction()

# The standard library and Eigen, most of what a unit reads, are read once for each SPEED: a seventh of the
# compiler's time. Not with TWINARM_UNITY=OFF, where each file shows that it compiles alone.
function(twinarm_share_headers target speed)
  if(NOT TWINARM_UNITY)
    return()
  endif()
  if(NOT speed OR NOT CMAKE_BUILD_TYPE STREQUAL "Release")
    set(speed normal)
  endif()
  set(shared twinarm_headers_${speed})
  if(NOT TARGET ${shared})
    file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${shared}.cpp CONTENT "")
    add_library(${shared} OBJECT ${CMAKE_BINARY_DIR}/${shared}.cpp)
    target_link_libraries(${shared} PRIVATE twinarm_flags Eigen3::Eigen)
    if(COMMAND twinarm_compile_${speed})
      cmake_language(CALL twinarm_compile_${speed} ${shared})
    endif()
    target_precompile_headers(${shared} PRIVATE
      <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional> <map> <memory> <numbers>
      <optional> <random> <set> <span> <sstream> <string> <vector> <Eigen/Dense>)
    twinarm_cache_headers(${shared})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${shared})
  twinarm_cache_headers(${target})
endfunction()
# What ccache asks of the compiler to cache what shares headers, beside the environment in CMakePresets.json;
# and programs are compiled as libraries are.
function(twinarm_cache_headers target)
  target_compile_options(${target} PRIVATE -fPIC
    $<IF:$<CXX_COMPILER_ID:GNU>,-fpch-preprocess,SHELL:-Xclang -fno-pch-timestamp>)
endfunction()
