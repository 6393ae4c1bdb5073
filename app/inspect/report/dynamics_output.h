// What `twinarm dynamics` prints: one JSON object, or tables for people.
#pragma once

#include <string>

#include "app/robot/dynamics.h"

namespace twinarm {

std::string dynamics_json(const RobotInput& input, const Dynamics& d);
std::string dynamics_table(const RobotInput& input, const Dynamics& d);

}  // namespace twinarm
