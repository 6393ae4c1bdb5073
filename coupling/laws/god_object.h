// The joints that a god object drives (coupling/laws/god_object_coupling.cpp): all of a robot.
#pragma once

#include "coupling/laws/coupling.h"

namespace twinarm {

// A spring without gains for each joint with degrees of freedom among the bodies.
std::vector<Spring> god_object_joints(const Model<double>& model, int first_body, int last_body);

}  // namespace twinarm
