// Options of `twinarm render`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/robot/robot_input.h"

namespace twinarm {

struct RenderOptions {
  RobotOptions robot;                           // its model: a recording, a scene or a URDF
  std::filesystem::path png, frames, mp4, gif;  // exactly one is given
  std::optional<double> at, from, to;           // [s]
  std::string size = "1280x720", camera = "auto", show = "ghost,couplings";
  std::string plot = "none", quality = "normal", background = "studio", gl = "osmesa";
  std::filesystem::path beside;  // a second recording; empty: none
  double slow = 1;               // times slower than life
  std::optional<double> fps;     // left out: 30, of a GIF 25
  bool json = false;
};

}  // namespace twinarm
