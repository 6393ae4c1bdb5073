// What the hand feels: the couplings' reaction on the kinematic robot, brought to the device.
//
//   pull of each spring on the DVR -> its reaction on the KVR's driven joints, tau = -J_K^T pull
//   -> the mapping's virtual work -> low-pass -> passivity -> clamp -> the motors' torques
//
// So a wall, a box that is pushed and the robot's own inertia are felt through the coupling, and
// nothing is felt of a robot that follows slowly and freely. docs/understand/haptic_rendering.md
#pragma once

#include <vector>

#include "coupling/device/device_mapping.h"
#include "coupling/device/passivity.h"
#include "coupling/laws/coupling_spec.h"

namespace twinarm {

// The generalised forces of couplings on driven joints of their kinematic robot.
class CouplingReaction {
 public:
  // `turned`: bodies that the driven joints carry. The model must outlive it.
  CouplingReaction(const Model<double>& model, const std::vector<int>& turned);
  // Another coupling whose reaction counts. It must outlive this.
  void add(const CouplingSpec& spec, const Coupling& coupling);
  // After each step of h [s] that ended in x, with D its kinematics and the KVR at its end. By
  // driven joint [N m, N]. An implicit pull lessened over the step by m* times the acceleration of
  // what it measures; so a call must follow each step.
  const std::vector<double>& after_step(const TargetSample& kvr, const State<double>& x,
                                        const Kinematics& D, double h) noexcept;

 private:
  enum class Kind { point, turn, joint };
  struct Part {  // a reading of a coupling
    const Coupling* coupling;
    std::size_t reading, spring;
    Kind kind;
    Vector3 velocity;  // of the DVR's side, before the step; of a joint in the first component
    bool known;
  };
  Vector3 velocity_of(const Part& part, const State<double>& x, const Kinematics& D) const;
  void add_reaction(const Part& part, const Vector3& pull, double size, const Kinematics& K);

  const Model<double>& model_;
  DrivenDofs driven_;
  std::vector<Part> parts_;
  std::vector<double> tau_;
};

struct HandForceSpec {
  double cutoff = 0;  // of the first-order low-pass [Hz]; 0: none
  bool passive = true;
  double fastest = 1.0;  // the hand goes no faster: what the floor of passivity is made of [m/s]
};

// The force that the motors' torques are at the stylus [N]: |J^-T torque|.
double stylus_force(const OmniParameters& omni, const OmniAngles& theta, const Vector3& torque);

class HandForce {
 public:
  // The mapping must outlive it.
  HandForce(const HandForceSpec& spec, const OmniParameters& omni, DeviceMapping& mapping);
  // For the motors, to be held until the next tick: after DeviceMapping::map() and the step. `tau`
  // by driven joint of the KVR, h [s] the tick.
  DeviceForce tick(const DeviceState& device, const std::vector<double>& tau, double h) noexcept;
  double energy() const { return passivity_.energy(); }  // that the hand has put in [J]

 private:
  HandForceSpec spec_;
  OmniParameters omni_;
  DeviceMapping& mapping_;
  PassivityControl passivity_;
  Vector3 smooth_ = Vector3::Zero();
};

}  // namespace twinarm
