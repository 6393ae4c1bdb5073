// The couplings of a scene at work: each with a hand, a kinematic robot and its springs.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "app/scene/scene_model.h"
#include "coupling/coupling.h"
#include "coupling/hand.h"
#include "coupling/kinematic_robot.h"
#include "solver/integrator_rewind.h"
#include "solver/simulation.h"

namespace twinarm {

class SceneCouplings {
 public:
  // For steps of h [s]. The scene must outlive it. Throws InputError with all faults: a trace that
  // cannot be read, a device (there is none without the lab), a rate that is no part of the steps.
  SceneCouplings(const SceneModel& scene, double h);
  SceneCouplings(const SceneCouplings&) = delete;
  SceneCouplings& operator=(const SceneCouplings&) = delete;
  ~SceneCouplings();

  std::size_t size() const { return ties_.size(); }
  ForceSource& source(std::size_t c);             // for Simulation::add; Rewindable
  const Coupling& coupling(std::size_t c) const;  // its readings are of the last evaluation
  // The kinematic side at a time, with the velocity of the motion after it. Not that of the source:
  // asking does not change the run. Valid until the next call.
  const KvrSample& target(std::size_t c, double t);

 private:
  struct Tie;
  std::vector<std::unique_ptr<Tie>> ties_;
};

}  // namespace twinarm
