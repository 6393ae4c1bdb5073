// PATH=VALUE: a change of one value of a scene file.
#pragma once

#include <string>

#include "app/data/value.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// "coupling[0].stiffness=800", "coupling.stiffness=800" (all), "coupling.NAME.stiffness=800",
// "robot.q.joint1=0.5", "gravity=0,0,-1.62", "gravity[2]=-1.62".
struct Change {
  std::string path, value;
};
// Throws InputError for what has no '='.
Change parse_change(const std::string& text);
// To a scene's tree; adds a fault where the path leads nowhere. Tables and keys below the top that
// are missing are made: the reader knows whether there are such. With another `type` a coupling
// loses the keys that the new one has not (app/scene/read/scene_keys.h). `line`: what it writes
// stands there.
void apply(const Change& change, int line, Value& scene, FaultList& faults);

}  // namespace twinarm
