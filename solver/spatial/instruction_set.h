// The passes are compiled once per level of the instruction set, each time in a namespace of its
// own, so that the linker can never put code for a newer processor where an older one runs it.
// solver/dynamics/dynamics.cpp chooses at run time.
#pragma once

#ifndef TWINARM_ISA
#define TWINARM_ISA generic
#endif

// What one joint does in one pass: a function of its own with everything inlined into it. g++ 12
// allocates registers well in a function of this size, and badly in one that holds all joints.
#define TWINARM_KERNEL __attribute__((flatten, noinline))
