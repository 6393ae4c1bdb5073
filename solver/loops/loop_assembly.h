// Puts a mechanism together: a state nearby in which its loops are closed.
#pragma once

#include <vector>

#include "solver/loops/loop_closure.h"

namespace twinarm {

// The state that comes from x by Gauss-Newton steps that are the shortest in the metric of M, each
// as long as it brings the loops nearer. Velocities go to the nearest that the loops allow.
// Followers go to their leaders. Closed to 1e-12, or to rounding where that is more.
// Throws InputError: loops that are no loops (check_loops), or that cannot be closed from there.
State<double> close_loops(const Model<double>& model, const std::vector<LoopClosure>& loops,
                          State<double> x);

}  // namespace twinarm
