// What can be wrong with loop closures, told before a run.
#pragma once

#include <vector>

#include "solver/loops/loop_closure.h"

namespace twinarm {

// What a start may be open by; the first step closes the rest [m, rad].
inline constexpr double kOpenAtStart = 1e-6;

// Throws one InputError with all faults: bodies that are not there, ends that cannot move against
// each other, frames that are none, lengths, joints of more than one dof, two loops that are the
// same.
void check_loops(const Model<double>& model, const std::vector<LoopClosure>& loops);
// The same, and which loops are open at x by more than kOpenAtStart.
void check_loops(const Model<double>& model, const std::vector<LoopClosure>& loops,
                 const State<double>& x);

}  // namespace twinarm
