// The one check of a step size, for all functions that take one from a caller.
#pragma once

namespace twinarm {

// Throws InputError unless h [s] is positive and finite.
void check_step_size(double h);

}  // namespace twinarm
