// What is simulated: a robot from a URDF, or a scene.
#pragma once

#include <memory>

#include "app/robot/robot_input.h"
#include "app/run/simulate_options.h"
#include "app/scene/forces/scene_couplings.h"
#include "app/scene/model/scene_model.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

struct SimulateInput {
  // Of a scene: the joints of all its robots, and the start that the state file has changed.
  RobotInput robot;
  std::unique_ptr<SceneModel> scene;          // null for a URDF
  std::unique_ptr<SceneCouplings> couplings;  // likewise
};

struct SimulatePlan {
  SimulateInput input;
  RunPlan run;
};

// Reads the robot or the scene and makes a plan of the options. Throws InputError with all faults.
SimulatePlan prepare_simulation(const SimulateOptions& options);

}  // namespace twinarm
