// What `twinarm inspect` looks at: a robot's URDF or a scene, the state, and who pushes.
#pragma once

#include <string>
#include <vector>

#include "app/inspect/inspection.h"
#include "app/simulate/simulate_input.h"

namespace twinarm {

// An impulse that was over before the forces act: velocities are those after it.
struct Inspected {
  State<double> x;
  std::vector<Actor> actors;
  std::vector<std::string> warnings;
  // Of a scene: accelerations of the step that was run, to be found again. Empty for a URDF.
  std::vector<double> qdd_of_step;
  std::vector<LoopClosure> loops;  // of a scene
};

// Friction, mimics, given torques and wrenches at the state.
Inspected inspect_robot(const RobotInput& input);

// The forces of the first semi-implicit step of h from the state: those, couplings, contacts,
// limits, constraints. `memory`: of an instant within a run (Simulation::visit_memory).
Inspected inspect_scene(SimulateInput& input, double h, Memory* memory = nullptr);

// Used by both: torques of the state file by joint, and its wrenches.
std::vector<Actor> given_actors(const RobotInput& input);
// By joint, of what acts on velocities; nothing of joints where it is zero.
void add_by_joint(const Model<double>& model, const std::vector<double>& tau,
                  const std::string& before, const std::string& after, std::vector<Actor>& actors);

}  // namespace twinarm
