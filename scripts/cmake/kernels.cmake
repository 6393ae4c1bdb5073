# Code that is compiled once for each level of the instruction set, in a namespace named after the
# level (TWINARM_ISA). Levels above generic only in optimised builds: there everything is inlined, and
# no function outside of those namespaces can be left over that the linker might take for others (a
# test looks).
#
# twinarm_kernel(NAME SOURCE LEVEL SCALAR) adds the object library NAME and appends its objects to
# KERNEL_OBJECTS of the caller.
set(TWINARM_LEVELS generic)
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  list(APPEND TWINARM_LEVELS v3 v4)
endif()

# Fused multiply-adds where the processor has them; both compilers' defaults differ, so it is set.
set(generic_flags -ffp-contract=off)
set(v3_flags -march=x86-64-v3 -ffp-contract=fast)
set(v4_flags -march=x86-64-v4 -ffp-contract=fast)
# Measured with g++ 12 on aba(): scheduling before register allocation gains 4 %; pairing scalars into
# vectors cost 6 % in an earlier form of the text, and makes no difference in today's.
set(pass_flags -O3 -Wno-psabi)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND pass_flags -fno-tree-slp-vectorize -fschedule-insns -fsched-pressure)
endif()
if(NOT CMAKE_BUILD_TYPE STREQUAL "Release")
  set(pass_flags -Wno-psabi)
endif()
set(double_flags ${pass_flags})
set(dual_flags ${pass_flags})
set(batch_flags ${pass_flags})
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_BUILD_TYPE STREQUAL "Release")
  # aba() of doubles takes 1 to 5 % less at v3 without these two, by measurement: it spills as before.
  # Not at the generic level: kinematics take 2 % more there.
  list(APPEND double_flags -fno-tree-ter -fno-gcse)
  # Dual<8> is nine numbers: without what takes the compiler longest on them, half of the time, and its
  # passes are as fast. Likewise a batch whose lanes fill several registers each.
  set(dual_flags -O2 -Wno-psabi -fno-tree-slp-vectorize -fno-tree-pre -fno-gcse
    -fno-schedule-insns2 -fno-expensive-optimizations -fira-algorithm=priority)
  # What a function returns is kept in registers lane by lane, however large the struct: without
  # these g++ copies transforms of lanes by way of the stack, 6 to 8 % of aba() at v4.
  list(APPEND batch_flags --param=sra-max-scalarization-size-Ospeed=4096
    --param=sra-max-propagations=1000)
endif()

function(twinarm_kernel name source level scalar)
  add_library(${name} OBJECT ${source})
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
  target_compile_definitions(${name} PRIVATE TWINARM_ISA=${level} "TWINARM_SCALAR=${scalar}")
  target_link_libraries(${name} PRIVATE twinarm_warnings)
  set(flags pass)
  if(scalar MATCHES "Dual" OR (level STREQUAL "generic" AND scalar MATCHES "Batch") OR
     (level STREQUAL "v3" AND scalar STREQUAL "Batch<8>"))
    set(flags dual)
  elseif(scalar MATCHES "Batch")
    set(flags batch)
  elseif(scalar STREQUAL "double" AND NOT level STREQUAL "generic")
    set(flags double)
  endif()
  target_compile_options(${name} PRIVATE
    ${TWINARM_SANITIZERS} ${${level}_flags} ${${flags}_flags} ${TWINARM_LATE_COLLECTION})
  set(KERNEL_OBJECTS ${KERNEL_OBJECTS} $<TARGET_OBJECTS:${name}> PARENT_SCOPE)
endfunction()

# For code that chooses among the levels.
function(twinarm_has_levels target)
  if("v3" IN_LIST TWINARM_LEVELS)
    target_compile_definitions(${target} PRIVATE TWINARM_HAS_LEVELS)
  endif()
endfunction()
