// Reads and writes a robot in URDF (https://wiki.ros.org/urdf/XML).
#pragma once

#include <filesystem>
#include <string>

#include "collision/import/robot/file_search.h"
#include "collision/import/robot/robot_description.h"

namespace twinarm {

// Throws InputError with all errors of the file, each with its line. Warnings:
// RobotDescription::warnings. Supported elements, defaults and extensions:
// collision/import/README.md.
RobotDescription read_urdf(const std::filesystem::path& file, const RobotFileOptions& options = {});

// Reading the file again gives a bit-identical description. `comment` is written at the top. Mesh
// paths are relative to the folder of `file`. The file is written to a temporary name and renamed.
// Throws InputError if it cannot be written.
void write_urdf(const RobotDescription& robot, const std::filesystem::path& file,
                const std::string& comment = "");

// The text of write_urdf, with mesh paths relative to `folder`.
std::string urdf_text(const RobotDescription& robot, const std::filesystem::path& folder,
                      const std::string& comment = "");

}  // namespace twinarm
