// The algorithms are compiled once per instruction-set level, each in its own namespace, so that
// the linker cannot merge code for a newer processor into code that older ones run.
// solver/dynamics/dynamics.cpp selects the level at run time.
#pragma once

#ifndef TWINARM_ISA
#define TWINARM_ISA generic
#endif

// Body of a visit_joint() call: one function per joint type with everything inlined into it. g++ 12
// allocates registers well in functions of this size, and poorly in one that holds all types.
#define TWINARM_KERNEL __attribute__((flatten, noinline))

// Before a loop over numbers whose results are none of its inputs: g++ then uses vector registers
// without checking that.
#ifdef __clang__
#define TWINARM_INDEPENDENT
#else
#define TWINARM_INDEPENDENT _Pragma("GCC ivdep")
#endif
