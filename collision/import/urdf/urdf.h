// Reads a robot in URDF (https://wiki.ros.org/urdf/XML).
#pragma once

#include <filesystem>

#include "collision/import/robot/robot_description.h"
#include "collision/import/urdf/mesh_search.h"

namespace twinarm {

struct UrdfOptions {
  // What collides and what is drawn. `optional` (enough for dynamics): a mesh that is missing and a
  // shape that cannot be read are warnings; the former stays in the description with an empty
  // `file`, the latter is left out. `required` (study, rendering, collision): they are faults.
  enum class Geometry { required, optional };
  Geometry geometry = Geometry::required;
  // An inertia that no rigid body can have is a fault, and not only a warning.
  bool strict = false;
  FileRoots roots = {};  // of meshes and textures
};

// Throws InputError with ALL faults of the file, each with its line. What was read but is
// suspicious, or has no effect here, stands in RobotDescription::warnings; what URDF takes for
// granted and what we add to it is told in collision/import/README.md.
RobotDescription read_urdf(const std::filesystem::path& file, const UrdfOptions& options = {});

}  // namespace twinarm
