// The automatic motion with a box in the way: the DVR stops at it, the KVR goes on through it.
#pragma once

#include "app/study/findings/results.h"

namespace twinarm {

// One coupling, linear or torsional (world), implicit at the obstacle's rate.
ObstacleRun run_obstacle(const StudyInputs& inputs, const StudyRobot& robot,
                         CouplingSpec::Type type);

}  // namespace twinarm
