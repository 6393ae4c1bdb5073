// What came from outside in one step of a run: with it the step can be taken again, bit for bit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/device/device_motion.h"
#include "solver/spatial/pose.h"

namespace twinarm {

// A spring-damper from a point of a body to a goal in the world.
struct PullInput {
  int body = 0;
  Vector3 p_L = Vector3::Zero();     // link axes [m]
  Vector3 goal_W = Vector3::Zero();  // [m]
  double k = 0, b = 0;               // [N/m], [N s/m]
  double most = 0;                   // of the spring's force [N]
};

struct LabInput {
  long step = 0;                 // that it went into; the first of a run is 1
  std::optional<HandStep> hand;  // where a hand led; else the scene's own did
  std::optional<PullInput> pull;
  double stamp = 0;  // of the newest command in it, as its sender gave it
};

// Names of ledger rows, by the numbers in frames.
struct LabNames {
  std::vector<std::string> rows, momentum_rows;
};

}  // namespace twinarm
