// Scenes as the workshop of the lab hands them over.
#pragma once

#include <string>
#include <utility>

#include "app/lab/session/scene_builder_thread.h"
#include "tests/app/scene/model/helpers.h"

namespace twinarm {

// The paper's robot, one joint of it drawn after a hand.
inline const char* const kSlowlyDriven = R"(
step = 0.001
duration = 1
[[robot]]
name = "arm"
model = "robots/s103/s103.urdf"
[[coupling]]
name = "one"
type = "torsional"
measure = "joint"
link = "arm1"
stiffness = 20
damping = 1
target = "device"
)";

inline Built built_from(const std::string& text) {
  const TemporaryFolder folder;
  Order order;
  order.file = folder.write("scene.toml", text);
  return build(std::move(order));
}

}  // namespace twinarm
