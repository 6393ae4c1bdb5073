// Mechanisms with closed loops as known motions.
#pragma once

#include "benchmarks/analytic/support/analytic_case.h"

namespace twinarm {

struct LoopCase;

// What a mechanism of loop_cases.h does in time. Its references are known at its times alone.
TrajectoryCase loop_motion(LoopCase (*make)());
void longer_crank(CaseScene& scene);  // by 0.1 %: the way from joint 1 to joint 2

}  // namespace twinarm
