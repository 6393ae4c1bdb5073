# One libm: what a hash covers must not depend on the C library nor on the processor. glibc's sines take
# fused multiply-adds where the processor has them; musl's (MIT, below 1 ulp) are plain C, and the ones of
# Emscripten. They are taken from Debian's musl-dev as one object, seen by our code alone: libraries that
# we load keep their own.
find_file(TWINARM_MUSL libc.a PATHS /usr/lib/${CMAKE_SYSTEM_PROCESSOR}-linux-musl /usr/lib/musl/lib
  /usr/${CMAKE_SYSTEM_PROCESSOR}-linux-musl/lib64
  NO_DEFAULT_PATH DOC "musl's C library, for its mathematical functions")
if(NOT TWINARM_MUSL)
  message(STATUS "The system's libm is used: last bits of results are its own (for golden hashes: musl-dev)")
  return()
endif()

set(functions acos acosh asin asinh atan atan2 atanh cbrt cos cosh erf erfc exp exp2 expm1 fmod hypot lgamma
  log log10 log1p log2 pow remainder sin sincos sinh tan tanh tgamma)
list(TRANSFORM functions PREPEND ".hidden " OUTPUT_VARIABLE wanted)
list(JOIN wanted "\n" wanted)
set(here ${CMAKE_BINARY_DIR}/libm)
file(WRITE ${here}.s "${wanted}\n.section .note.GNU-stack,\"\",@progbits\n")
list(TRANSFORM functions PREPEND --keep-global-symbol=)
execute_process(
  COMMAND ${CMAKE_CXX_COMPILER} -c ${here}.s -o ${here}.names.o
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(
  COMMAND ${CMAKE_LINKER} -r ${here}.names.o ${TWINARM_MUSL} -o ${here}.o
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(
  COMMAND ${CMAKE_OBJCOPY} ${functions} ${here}.o
  COMMAND_ERROR_IS_FATAL ANY)
target_sources(twinarm_flags INTERFACE
  $<$<IN_LIST:$<TARGET_PROPERTY:TYPE>,EXECUTABLE$<SEMICOLON>MODULE_LIBRARY>:${here}.o>)
