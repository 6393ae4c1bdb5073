// The cases with closed loops, group D of docs/cases.md.
#pragma once

#include <vector>

#include "benchmarks/analytic/support/analytic_case.h"

namespace twinarm {

struct LoopCase;

// What a mechanism of loop_cases.h does in time. Its references are known at its times alone.
TrajectoryCase loop_motion(LoopCase (*make)());

const std::vector<CaseFamily>& loop_cases();  // made by twinarm_registry()

}  // namespace twinarm
