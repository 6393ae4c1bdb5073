// Reads a robot in URDF (https://wiki.ros.org/urdf/XML).
#pragma once

#include <filesystem>

#include "collision/import/robot_description.h"

namespace twinarm {

// Throws InputError with ALL faults of the file, each with its line.
//
// Joints supported today: fixed, revolute, continuous, prismatic, floating; a <mimic> is refused.
// A root link that stands on the world may lack <inertial> (`has_inertia` tells: a floating base
// needs it). Of <limit>, a missing `lower` or `upper` is 0, as URDF has it, but not both. The
// element <twinarm armature="" coulomb_plus="" coulomb_minus=""/> inside a joint is read. Elements
// of other programs (transmission, gazebo, ...) are left out.
RobotDescription read_urdf(const std::filesystem::path& file);

}  // namespace twinarm
