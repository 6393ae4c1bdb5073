// Reads a robot in URDF (https://wiki.ros.org/urdf/XML).
#pragma once

#include <filesystem>

#include "collision/import/robot/file_search.h"
#include "collision/import/robot/robot_description.h"

namespace twinarm {

// Throws InputError with ALL faults of the file, each with its line. What was read but is
// suspicious, or has no effect here, stands in RobotDescription::warnings; what URDF takes for
// granted and what we add to it is told in collision/import/README.md.
RobotDescription read_urdf(const std::filesystem::path& file, const RobotFileOptions& options = {});

}  // namespace twinarm
