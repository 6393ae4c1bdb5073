// View of a run whose end is unknown: extent by the robots' reach, and scales that grow.
#pragma once

#include "app/draw/scene_view.h"
#include "app/robot/robot_input.h"

namespace twinarm {

// Extends the view by what is at the start; by the robots at 64 joint positions (Halton sequence
// within the limits, one revolution where there are none), of robots with constraints only the
// first links; and by one revolution of the bodies that are hinged to the world. For a robot on the
// ground points below count as on the ground.
void extend_by_reach(SceneView& stage, const RobotInput& robots, const Snapshot& start);
// Camera, ground, first scales, and the input device's place, which is in view if `has_device`.
void set_live_view(SceneView& stage, const Snapshot& start, bool has_device);

// Scales for the snapshot; each grows at most one round step (1, 2, 5).
void grow_scales(SceneView& stage, const Snapshot& snapshot);

// Adds the bodies' centres of mass to the trails: the last 10 s are drawn, ten minutes are stored.
// Removes points later than the snapshot.
void extend_trails(SceneView& stage, const Snapshot& snapshot);

}  // namespace twinarm
