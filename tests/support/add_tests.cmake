# Registers tests so that a test that could not run is never reported as passed: it exits 77, which ctest shows as
# Skipped. scripts/test lists what was skipped and why; with --no-skips, and where CI=true, a skip is a failure.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(TWINARM_TEST_SUPPORT ${CMAKE_CURRENT_LIST_DIR})

# twinarm_add_test(NAME COMMAND [ARGUMENT...])
function(twinarm_add_test name)
  add_test(NAME ${name} COMMAND ${ARGN})
  set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77)
endfunction()

# twinarm_add_python_test(NAME FILE [ARGUMENT...]): a file of unittest; FILE from the current folder.
function(twinarm_add_python_test name file)
  cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
  twinarm_add_test(${name} Python3::Interpreter -B ${TWINARM_TEST_SUPPORT}/run_test.py ${file} ${ARGN})
endfunction()

# twinarm_add_skipped_test(NAME REASON): stands for a test that cannot be built here.
function(twinarm_add_skipped_test name reason)
  twinarm_add_test(${name} sh -c "echo 'skipped: ${reason}' && exit 77")
endfunction()
