// What a page brings: a robot, a scene or a recording is opened; meshes and textures wait for the
// robot that names them; all else is refused with a word of what it is.
#pragma once

#include <string>

namespace twinarm {

struct BroughtFile {
  std::string path;    // that it is written to: of a robot in .xml or .xacro, .urdf
  bool opens = false;  // else it is kept
  std::string fault;   // empty: none
};

BroughtFile brought_file(const std::string& name, const std::string& bytes);

}  // namespace twinarm
