// What `twinarm inspect` looks at: a robot's URDF or a scene, the state, and who pushes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/inspect/inspection.h"
#include "app/run/simulate_input.h"
#include "solver/forces/force_source.h"
#include "solver/integration/integrator.h"
#include "solver/support/state_archive.h"

namespace twinarm {

// An impulse that was over before the forces act: velocities are those after it.
struct Inspected {
  State<double> x;
  std::vector<AppliedForce> actors;
  std::vector<std::string> warnings;
  // Of a scene: accelerations of the step that was run, to be found again. Empty for a URDF.
  std::vector<double> qdd_of_step;
  std::vector<LoopClosure> loops;  // of a scene
};

// Friction, mimics, given torques and wrenches at the state.
Inspected inspect_robot(const RobotInput& input);

// What pushes besides all that the scene has; added after its couplings.
struct NamedSource {
  std::string name;
  ForceSource* source;                          // Rewindable
  std::optional<std::pair<int, Vector3>> at{};  // body and point of it, link axes
};

// The forces of the semi-implicit step of h from an instant: those given, couplings, contacts,
// limits, constraints. What it is made of is read and built once, for as many instants as are asked
// for; the input and the sources must outlive it, and the input's state goes along.
class SceneInspector {
 public:
  // `of_run`: the integrator of the run that the memory of look() is of. With it limits act or do
  // not, and free bodies are stepped under constraints or are not.
  SceneInspector(SimulateInput& input, double h, const std::vector<NamedSource>& others = {},
                 Integrator of_run = Integrator::semi_implicit);
  ~SceneInspector();
  // From the state of the last call, or of the input; or from an instant within a run that was
  // built alike (Simulation::serialize; throws as that does).
  Inspected look(StateArchive* memory = nullptr);

 private:
  class FirstStep;
  std::unique_ptr<FirstStep> step_;
};

// The same of one instant.
Inspected inspect_scene(SimulateInput& input, double h, StateArchive* memory = nullptr,
                        Integrator of_run = Integrator::semi_implicit);

// Used by both: torques of the state file by joint, and its wrenches.
std::vector<AppliedForce> given_actors(const RobotInput& input);
// By joint, of what acts on velocities; nothing of joints where it is zero.
void add_by_joint(const Model<double>& model, const std::vector<double>& tau,
                  const std::string& before, const std::string& after,
                  std::vector<AppliedForce>& actors);

}  // namespace twinarm
