// The couplings of a scene at work: each with a hand, a kinematic robot and its springs. Numbered
// by their pulls (SceneCoupling).
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "app/scene/model/scene_model.h"
#include "coupling/laws/coupling.h"
#include "coupling/target/operator_motion.h"
#include "coupling/target/target_robot.h"
#include "solver/stepping/simulation.h"
#include "solver/support/checkpointable.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// What moves the kinematic side of a pull in place of the hand that the scene gives it, which is
// handed over to be asked. Pulls with one kinematic robot between them are asked for once.
using HandInPlace = std::function<std::unique_ptr<OperatorMotion>(
    std::size_t pull, std::unique_ptr<OperatorMotion> own)>;

// As the scene says of the pull; `device` is what couplings with target = "device" follow, nullptr
// where none is connected. Adds a fault for a trace that cannot be read.
std::unique_ptr<OperatorMotion> make_hand(const SceneModel& scene, std::size_t pull,
                                          const OperatorMotion* device, const HandInPlace& in_place,
                                          DiagnosticList& faults);

// A spring-damper as it stands in one state. Linear: the points of the link in both robots.
// Torsional: rotation vectors in the world; at a joint its coordinate, in the first component.
struct CouplingEnds {
  Vector3 offset = Vector3::Zero();    // of the target, from the link [m, rad]
  Vector3 velocity = Vector3::Zero();  // of the link
  Vector3 target_velocity = Vector3::Zero();
};

class SceneCouplings {
 public:
  // For steps of h [s]. The scene must outlive it, and so must the hand of a device: what couplings
  // with target = "device" follow; nullptr where none is connected, and they stand still. Throws
  // InputError with all faults: a trace that cannot be read, a rate that is no part of the steps.
  SceneCouplings(const SceneModel& scene, double h, const OperatorMotion* device = nullptr,
                 const HandInPlace& in_place = {});
  SceneCouplings(const SceneCouplings&) = delete;
  SceneCouplings& operator=(const SceneCouplings&) = delete;
  ~SceneCouplings();

  std::size_t size() const { return ties_.size(); }
  // For Simulation::add; Rewindable. nullptr where an earlier pull has it already.
  ForceSource* source(std::size_t c);
  const Coupling& coupling(std::size_t c) const;  // not of a soft stop
  const CouplingSpec& law(std::size_t c) const;   // what it was made of
  const TargetRobot& kvr(std::size_t c) const;    // as the last step saw it
  // The kinematic side at a time, with the velocity of the motion after or before it: they differ
  // at a corner. Not that of the source: asking does not change the run. Valid until the next call.
  enum class Side { after, before };
  const TargetSample& target(std::size_t c, double t, Side side = Side::after);
  // The DVR at x and its kinematics k, at the time x.t.
  CouplingEnds ends(std::size_t c, const State<double>& x, const Kinematics& k,
                    Side side = Side::after);
  // Spring and damper at x against a kinematic side that stands still: a smooth push, for the
  // linear theory about a state.
  void hold_still(std::size_t c, const State<double>& x, const Kinematics& k,
                  Forces<double>& forces);
  // The pull of the last evaluation, in the same components.
  Vector3 pull(std::size_t c) const;
  // The weightless inertia that the treatment added in the last step
  // (docs/understand/coupling_laws.md).
  double m_star(std::size_t c) const;
  const SceneCoupling& spec(std::size_t c) const { return scene_.couplings[c]; }
  // What moves the kinematic side; of a target that stands still a hand at rest.
  const OperatorMotion& hand(std::size_t c) const;
  // Hands lead otherwise now, also at times that were looked at.
  void forget_hands();

 private:
  struct Twin;
  struct Tie;
  const SceneModel& scene_;
  std::vector<std::shared_ptr<Tie>> ties_;  // by pull
};

}  // namespace twinarm
