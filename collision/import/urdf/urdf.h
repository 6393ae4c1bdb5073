// Reads and writes a robot in URDF (https://wiki.ros.org/urdf/XML).
#pragma once

#include <filesystem>
#include <string>

#include "collision/import/robot/file_search.h"
#include "collision/import/robot/robot_description.h"

namespace twinarm {

// Throws InputError with ALL faults of the file, each with its line. What was read but is
// suspicious, or has no effect here, stands in RobotDescription::warnings; what URDF takes for
// granted and what we add to it is told in collision/import/README.md.
RobotDescription read_urdf(const std::filesystem::path& file, const RobotFileOptions& options = {});

// Reading the file again gives the same description to the last bit. `comment` stands at the top,
// line by line. Mesh files are named relative to the folder of `file`. The file is written under a
// temporary name and renamed, so that a reader never sees half of it. Throws InputError where the
// file cannot be written.
void write_urdf(const RobotDescription& robot, const std::filesystem::path& file,
                const std::string& comment = "");

// The text that write_urdf writes, with mesh files named relative to `folder`.
std::string urdf_text(const RobotDescription& robot, const std::filesystem::path& folder,
                      const std::string& comment = "");

}  // namespace twinarm
