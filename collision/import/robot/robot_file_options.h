// How strictly a robot's file is read, and which other files it may name.
#pragma once

#include "collision/import/robot/file_search.h"

namespace twinarm {

struct RobotFileOptions {
  // What collides and what is drawn. `optional` (enough for dynamics): a mesh that is missing and a
  // shape that cannot be read are warnings; the former stays in the description with an empty
  // `file`, the latter is left out. `required` (study, rendering, collision): they are faults.
  enum class Geometry { required, optional };
  Geometry geometry = Geometry::required;
  // An inertia that no rigid body can have is a fault, and not only a warning.
  bool strict = false;
  FileRoots roots = {};  // of meshes and textures
};

}  // namespace twinarm
