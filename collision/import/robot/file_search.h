// How strictly a robot's file is read, and where the file of a mesh or texture lies that it names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace twinarm {

// Where a file may lie that another file names: below one of these folders, or one of these files.
// Nothing: anywhere.
using FileRoots = std::optional<std::vector<std::filesystem::path>>;
// Follows "..", and links.
bool may_name(const FileRoots& roots, const std::filesystem::path& file);

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

struct FilePlace {
  std::filesystem::path file;  // absolute; empty where it was not found
  std::string problem, fix;    // then: why not, and what to do
  std::string_view code;       // of the fault
};

// A name without scheme, or with file://, is relative to `folder` (that of the robot's file) unless
// it is absolute. package://NAME/rest and model://NAME/rest: NAME is a folder that contains
// `folder`, or lies in one that does; or a package in a folder of ROS_PACKAGE_PATH, at most two
// levels down, or of AMENT_PREFIX_PATH (share/NAME); or, at last, `folder` itself.
// `kind` is what faults call it.
FilePlace find_named_file(const std::string& kind, const std::string& name,
                          const std::filesystem::path& folder, const FileRoots& roots = {});

}  // namespace twinarm
