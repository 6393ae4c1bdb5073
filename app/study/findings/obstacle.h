// The automatic motion with a box in the way: the DVR stops at it, the KVR goes on through it.
#pragma once

#include <functional>

#include "app/study/findings/results.h"

namespace twinarm {

// The box, where the picture and the contact law want it.
struct ObstacleScene {
  Pose X_WB;
  Vector3 size;
};
ObstacleScene obstacle_scene(const StudySettings& settings);

// One coupling, linear or torsional (world), implicit at the obstacle's rate. `at_picture` is
// called once, with the system, when the KVR is farthest beyond.
ObstacleRun run_obstacle(const StudyInputs& inputs, const StudyRobot& robot,
                         CouplingSpec::Type type,
                         const std::function<void(TrackingSystem&)>& at_picture);

}  // namespace twinarm
