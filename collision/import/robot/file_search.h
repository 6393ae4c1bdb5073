// Options of reading a robot file, and the search for the mesh and texture files that it refers to.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace twinarm {

// Allowed locations of referenced files: below these folders, or these files. Empty optional:
// anywhere.
using FileRoots = std::optional<std::vector<std::filesystem::path>>;
// Resolves ".." and links.
bool may_name(const FileRoots& roots, const std::filesystem::path& file);

struct RobotFileOptions {
  // Collision and visual shapes. `optional` (enough for dynamics): missing meshes (kept with an
  // empty `file`) and invalid shapes (left out) are warnings. `required`: they are errors.
  enum class Geometry { required, optional };
  Geometry geometry = Geometry::required;
  // A physically impossible inertia is an error instead of a warning.
  bool strict = false;
  // An <inertial> without mass or inertia is a warning instead of an error; what is missing is
  // zero.
  bool incomplete_inertia = false;
  FileRoots roots = {};  // of meshes and textures
};

struct FilePlace {
  std::filesystem::path file;  // absolute; empty if not found
  std::string problem, fix;    // diagnostic if not found
  std::string_view code;
};

// A name without scheme, or with file://, is absolute or relative to `folder` (that of the robot
// file). For package://NAME/rest and model://NAME/rest, NAME is searched as: a folder above
// `folder` or beside one of these; a package at most two levels below a folder of ROS_PACKAGE_PATH;
// share/NAME in AMENT_PREFIX_PATH; `folder` itself. `kind`: word for diagnostics.
FilePlace find_named_file(const std::string& kind, const std::string& name,
                          const std::filesystem::path& folder, const FileRoots& roots = {});

}  // namespace twinarm
