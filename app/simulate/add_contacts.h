// Where contacts and constraints come into a run. They are not computed yet: until they are, a
// scene that needs them is refused.
#pragma once

#include "app/scene/scene_model.h"
#include "solver/fault.h"
#include "solver/simulation.h"

namespace twinarm {

// What this program cannot compute of the scene.
void check_contacts(const SceneModel& scene, FaultList& faults);

// Puts contacts and constraints into the simulation, before its first step.
void add_contacts(const SceneModel& scene, Simulation& simulation);

}  // namespace twinarm
