// Input of `twinarm inspect`: state and named forces of a robot or of a step of a scene.
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

// Velocities are those after impacts at the start of the step.
struct Inspected {
  State<double> x;
  std::vector<AppliedForce> actors;
  std::vector<std::string> warnings;
  std::vector<double> qdd_of_step;  // of a scene, for the cross-check
  std::vector<LoopClosure> loops;   // of a scene
};

// Friction, mimic joints, given torques and wrenches at the state.
Inspected inspect_robot(const RobotInput& input);

// A force source besides those of the scene; added after its couplings.
struct NamedSource {
  std::string name;
  ForceSource* source;                          // Rewindable
  std::optional<std::pair<int, Vector3>> at{};  // body and point, link axes
};

// Forces of a semi-implicit step of h from an instant: given forces, couplings, contacts, limits,
// constraints. Built once for any number of instants; the input and the sources must outlive it,
// and look() changes the input's state.
class SceneInspector {
 public:
  // `of_run`: integrator of the run whose archives look() reads. It decides whether limits act and
  // whether free bodies are stepped with constraints.
  SceneInspector(SimulateInput& input, double h, const std::vector<NamedSource>& others = {},
                 Integrator of_run = Integrator::semi_implicit);
  ~SceneInspector();
  // From the archive of an instant of the run (Simulation::serialize, throws likewise); without
  // one, from the state of the last call or of the input.
  Inspected look(StateArchive* memory = nullptr);

 private:
  class FirstStep;
  std::unique_ptr<FirstStep> step_;
};

// Torques and wrenches of the state file.
std::vector<AppliedForce> given_actors(const RobotInput& input);
// Adds a force "BEFORE joint AFTER" for each joint with nonzero tau (by velocity).
void add_by_joint(const Model<double>& model, const std::vector<double>& tau,
                  const std::string& before, const std::string& after,
                  std::vector<AppliedForce>& actors);

}  // namespace twinarm
