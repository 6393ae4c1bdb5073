// The parts of build_scene. Only app/scene/build_*.cpp include it.
#pragma once

#include "app/scene/model/scene_model.h"
#include "app/scene/read/read_scene.h"

namespace twinarm {

// The body of the model that is meant; 0 for the world and for fixed bodies.
int body_of(const SceneModel& scene, const SceneReference& reference);

void build_geometries(SceneModel& scene);  // also `apart` and `pairs`; after the constraints
void build_couplings(SceneModel& scene);
void build_constraints(SceneModel& scene);

// Writes joint values by name into the state.
void set_coordinates(const SceneModel& scene, std::size_t robot, const JointValueMap& q,
                     State<double>& x);
void set_velocities(const SceneModel& scene, std::size_t robot, const JointValueMap& qd,
                    State<double>& x);

}  // namespace twinarm
