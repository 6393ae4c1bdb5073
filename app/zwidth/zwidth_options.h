// Options of `twinarm zwidth`.
#pragma once

#include <filesystem>

namespace twinarm {

struct ZwidthOptions {
  double mass = 0.045, damping = 0.1;           // of the device [kg], [N s/m]
  double friction = 0.26, resolution = 5.5e-5;  // [N], [m]
  double rate = 1000;                           // [Hz]
  int delay = 0;                                // [ticks]
  double wall_damping = 1;                      // [N s/m]
  unsigned seed = 1;
  std::filesystem::path svg, png;  // empty: none
  bool csv = false, json = false;
};

}  // namespace twinarm
