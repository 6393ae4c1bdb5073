// The stage of a run whose end nobody knows: what is in view, and scales that grow with the run.
#pragma once

#include "app/draw/scene_view.h"
#include "app/robot/robot_input.h"

namespace twinarm {

// Of interest: what is at the start, and where the joints of robots can bring them: at 64 points of
// the space of their joints (Halton's sequence; within limits, a turn where there are none). Of a
// robot that stands on the ground what would be below counts as on it.
void look_around(SceneView& stage, const RobotInput& robots, const Snapshot& start);
// Of what is of interest: camera, ground, first scales and the place of the hand device, which is
// in view too where `has_hand`.
void set_live_view(SceneView& stage, const Snapshot& start, bool has_hand);

// What shows in a moment; each scale grows by one round step (1, 2, 5) at most. True: one did.
bool grow_scales(SceneView& stage, const Snapshot& moment);

// Where bodies are, for trails: the last 10 s are drawn, ten minutes are kept. What lies later than
// the moment is forgotten: a run that was taken up at an earlier time.
void leave_trail(SceneView& stage, const Snapshot& moment);

}  // namespace twinarm
