// Implementation of build_scene(); only build_*.cpp include it.
#pragma once

#include "app/scene/model/scene_model.h"
#include "app/scene/read/read_scene.h"

namespace twinarm {

// Index of the body in the model; 0 for the world and for fixed bodies.
int body_of(const SceneModel& scene, const SceneReference& reference);

// Child of a joint of one of the robots, by "robot/joint".
int child_of(const SceneModel& scene, const std::string& joint);

void build_geometries(SceneModel& scene);  // after the constraints; also `pairs`, `roots`, `joined`
void build_couplings(SceneModel& scene);
void build_constraints(SceneModel& scene);

// Set joint positions or velocities by name in a state.
void set_coordinates(const SceneModel& scene, std::size_t robot, const JointValueMap& q,
                     State<double>& x);
void set_velocities(const SceneModel& scene, std::size_t robot, const JointValueMap& qd,
                    State<double>& x);

}  // namespace twinarm
