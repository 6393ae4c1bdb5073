// Options of `twinarm inspect`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/robot/robot_input.h"

namespace twinarm {

struct InspectOptions {
  std::filesystem::path html;  // a page; empty: text on stdout
  RobotOptions robot;
  std::vector<std::string> passes, bodies;  // none: all
  std::string axes = "world";               // of the wrenches: world, link, or a body's name
  std::string about = "origin";             // origin, com, a body's name, or x,y,z in the world
  std::vector<std::string> forces;          // by name; none: all
  std::optional<double> step;               // of a scene [s]; left out: the scene's
  std::optional<double> at;                 // of a recording [s]; left out: its end
  bool json = false;
};

}  // namespace twinarm
