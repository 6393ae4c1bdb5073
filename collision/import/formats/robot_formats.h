// Registered formats of robot files.
#pragma once

#include <filesystem>
#include <vector>

#include "collision/import/robot/file_search.h"
#include "collision/import/robot/robot_description.h"

namespace twinarm {

// The file NAME_format.cpp defines `RobotFormat NAME_format()`.
struct RobotFormat {
  const char* extension;  // with the dot
  // Throws InputError with all errors of the file, each with its line. The robot has passed
  // check_robot (robot_check.h).
  RobotDescription (*read)(const std::filesystem::path& file, const RobotFileOptions& options);
};
const std::vector<RobotFormat>& robot_formats();

// By the format of the extension, else as URDF.
RobotDescription read_robot_file(const std::filesystem::path& file,
                                 const RobotFileOptions& options = {});

}  // namespace twinarm
