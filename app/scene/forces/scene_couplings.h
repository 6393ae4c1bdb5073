// The couplings of a run: each with an operator motion, a target robot and its springs. Indices are
// those of SceneModel::couplings.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "app/scene/model/scene_model.h"
#include "coupling/laws/coupling.h"
#include "coupling/target/operator_motion.h"
#include "coupling/target/target_robot.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// Replaces the operator motion `own` of a coupling; called once for each target robot.
using MotionReplacement = std::function<std::unique_ptr<OperatorMotion>(
    std::size_t coupling, std::unique_ptr<OperatorMotion> own)>;

// The operator motion of a coupling; `device`: that of target = "device", nullptr if none is
// connected. Adds a diagnostic for a trace that cannot be read.
std::unique_ptr<OperatorMotion> make_operator_motion(const SceneModel& scene, std::size_t coupling,
                                                     const OperatorMotion* device,
                                                     const MotionReplacement& in_place,
                                                     DiagnosticList& faults);

// A spring-damper in one state, world axes. Linear: the points of the link in both robots.
// Torsional: rotation vectors; at a joint its position, in the first component.
struct CouplingEnds {
  Vector3 offset = Vector3::Zero();    // target minus link [m, rad]
  Vector3 velocity = Vector3::Zero();  // of the link
  Vector3 target_velocity = Vector3::Zero();
};

class SceneCouplings {
 public:
  // For steps of h [s]. Keeps references to scene and device. Without a device, targets "device"
  // stay at rest. Throws InputError for unreadable traces and for rates that do not divide 1/h.
  SceneCouplings(const SceneModel& scene, double h, const OperatorMotion* device = nullptr,
                 const MotionReplacement& in_place = {});
  SceneCouplings(const SceneCouplings&) = delete;
  SceneCouplings& operator=(const SceneCouplings&) = delete;
  ~SceneCouplings();

  std::size_t size() const { return couplings_.size(); }
  // For Simulation::add; nullptr for all but the first component of a coupling.
  ForceSource* source(std::size_t c);
  const Coupling& coupling(std::size_t c) const;  // not for soft limits
  const CouplingSpec& law(std::size_t c) const;
  const TargetRobot& kvr(std::size_t c) const;  // in the last step
  // The target at a time, with the velocity after or before it (they differ at a corner). A copy
  // for output, valid until the next call: does not change the run.
  enum class Side { after, before };
  const TargetSample& target(std::size_t c, double t, Side side = Side::after);
  // For the robot at x, with its kinematics k, at the time x.t.
  CouplingEnds ends(std::size_t c, const State<double>& x, const Kinematics& k,
                    Side side = Side::after);
  // Adds spring and damper forces at x with the target at rest, for linearisation.
  void hold_still(std::size_t c, const State<double>& x, const Kinematics& k,
                  Forces<double>& forces);
  // Coupling force of the last evaluation, in the same components.
  Vector3 force(std::size_t c) const;
  double m_star(std::size_t c) const;  // added inertia in the last step
  const SceneCoupling& spec(std::size_t c) const { return scene_.couplings[c]; }
  const OperatorMotion& motion(std::size_t c) const;
  // After a change of operator motions: discards cached targets.
  void forget_operator_motions();

 private:
  struct Target;
  struct Active;
  const SceneModel& scene_;
  std::vector<std::shared_ptr<Active>> couplings_;  // components share one
};

}  // namespace twinarm
