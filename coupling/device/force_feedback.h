// Force feedback: the reaction of the couplings on the target robot, mapped to the device
// (docs/understand/haptic_rendering.md).
//
//   coupling force on the DVR -> reaction on the KVR's driven joints, tau = -J_K^T f
//   -> virtual work of the mapping -> low-pass -> passivity controller -> clamp -> motor torques
#pragma once

#include <vector>

#include "coupling/device/device_mapping.h"
#include "coupling/device/passivity.h"
#include "coupling/laws/coupling_spec.h"

namespace twinarm {

// Joint forces of couplings on the driven joints of the target robot.
class CouplingReaction {
 public:
  // `turned`: bodies of the driven joints. The model must outlive it.
  CouplingReaction(const Model<double>& model, const std::vector<int>& turned);
  // Adds a coupling, which must outlive this.
  void add(const CouplingSpec& spec, const Coupling& coupling);
  // Call after each step of h [s] that ended in x, with its kinematics D and the KVR at its end.
  // Result by driven joint [N m, N]. The mean force of an implicit spring is reduced by m* times
  // the acceleration.
  const std::vector<double>& after_step(const TargetSample& kvr, const State<double>& x,
                                        const Kinematics& D, double h) noexcept;

 private:
  enum class Kind { point, orientation, joint };
  struct Part {  // a spring state of a coupling
    const Coupling* coupling;
    std::size_t reading, spring;
    Kind kind;
    Vector3 velocity;  // of the DVR before the step; of a joint: first component
    bool known;
  };
  Vector3 velocity_of(const Part& part, const State<double>& x, const Kinematics& D) const;
  void add_reaction(const Part& part, const Vector3& force, double size, const Kinematics& K);

  const Model<double>& model_;
  DrivenDofs driven_;
  std::vector<Part> parts_;
  std::vector<double> tau_;
};

struct ForceFeedbackSpec {
  double cutoff = 0;  // of the first-order low-pass [Hz]; 0: none
  bool passive = true;
  double fastest = 1.0;  // maximum operator speed, for the energy bound [m/s]
};

// Force of motor torques at the stylus [N]: |J^-T torque|.
double stylus_force(const OmniParameters& omni, const OmniAngles& theta, const Vector3& torque);

class ForceFeedback {
 public:
  // The mapping must outlive it.
  ForceFeedback(const ForceFeedbackSpec& spec, const OmniParameters& omni, DeviceMapping& mapping);
  // Motor torques until the next tick, after DeviceMapping::map() and the step. tau: by driven
  // joint of the KVR; h: tick [s].
  DeviceForce tick(const DeviceState& device, const std::vector<double>& tau, double h) noexcept;
  double energy() const { return passivity_.energy(); }  // observed energy of the operator [J]

 private:
  ForceFeedbackSpec spec_;
  OmniParameters omni_;
  DeviceMapping& mapping_;
  PassivityControl passivity_;
  Vector3 smooth_ = Vector3::Zero();
};

}  // namespace twinarm
