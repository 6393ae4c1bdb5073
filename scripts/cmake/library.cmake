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
endfunction()

# The library of this folder where its objects are compiled several times (kernels.cmake), or made.
function(twinarm_library_of_objects)
  cmake_parse_arguments(L "" "" "USES;OBJECTS" ${ARGN})
  twinarm_layer(name uses USES ${L_USES})
  add_library(${name} STATIC ${L_OBJECTS})
  set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
  target_link_libraries(${name} PUBLIC $<BUILD_INTERFACE:twinarm_flags> Eigen3::Eigen ${uses})
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
# bits stay. g++ 12 then warns of copies in std::string that overlap, which they do not (PR 105651).
function(twinarm_compile_hard target)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${target} PRIVATE -O3 $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
  endif()
endfunction()
