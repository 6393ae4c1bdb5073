// From a hand device to the kinematic robot, and the force back (docs/understand/haptic_rendering.md).
//
//   paper      theta1, theta4, theta6 of the device turn joints 1, 2, 3 of the robot. Only theta1
//              has a motor: of the robot's torques the hand feels that of joint 1 alone.
//   arm        theta1, theta2, theta3 turn joints 1, 2, 3: all three can be felt.
//   cartesian  the stylus' point moves a point of the robot, whose joints follow by inverse
//              kinematics: forces on that point are felt in their own directions.
//
// Joint mappings: q_j = offset_j + gain_j theta_d(j), so by virtual work the motor d(j) feels
// gain_j tau_j, whatever the gain: a mapping that magnifies motion magnifies force too.
// `force_scale` multiplies it. A clutch (second button) lets go: while it is held the robot stands
// and the device moves freely; when it is let go the robot goes on from where it stood, without a
// jump. A device that is not alive, or says what is not a number, is one whose clutch is held.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coupling/device/input_device.h"
#include "coupling/target/operator_motion.h"
#include "solver/dynamics/kinematics.h"
#include "solver/model/model.h"

namespace twinarm {

enum class MappingKind { paper, arm, cartesian };
inline constexpr std::array<const char*, 3> kMappingNames{"paper", "arm", "cartesian"};

// The HandMapping is of joint mappings; `arm` has device joints of its own.
struct MappingSpec : HandMapping {
  MappingKind kind = MappingKind::paper;
  // Of cartesian: the robot's point follows p_start + scale (stylus - stylus at the start), in
  // world axes. A workspace of 16 cm against a reach of 60: scale 4.
  double scale = 4.0;
  // Likewise: no joint turns faster. Beside a stretched arm, or the first joint's axis, it would
  // have to jump [rad/s, m/s].
  double fastest = 20;
  double force_scale = 1.0;
};

// What is moved: joints of the kinematic robot, and the point that follows the stylus.
struct MappedRobot {
  const Model<double>* model = nullptr;  // must outlive the mapping
  State<double> stand;                   // where the joints stand that the hand does not move
  std::vector<int> turned;               // bodies that the driven joints carry
  std::vector<double> lower, upper;      // their ranges [rad, m]; empty: none
  int body = 0;                          // the point, of cartesian: on this body,
  Vector3 p_L = Vector3::Zero();         // link axes [m]
};

// By velocity of the model: which of the driven joints moves it, or -1, and how fast, as a mimic.
struct DrivenDofs {
  std::vector<int> joint;
  std::vector<double> ratio;
  DrivenDofs(const Model<double>& model, const std::vector<int>& turned)
      : joint(model.nv, -1), ratio(model.nv, 1.0) {
    for (std::size_t j = 0; j < turned.size(); ++j)
      joint[model.iv[static_cast<std::size_t>(turned[j])]] = static_cast<int>(j);
    for (const Mimic& mimic : model.mimics)
      if (joint[mimic.leader] >= 0) {
        joint[mimic.follower] = joint[mimic.leader];
        ratio[mimic.follower] = mimic.ratio;
      }
  }
};

// Where the hand wants the robot. Joints in the order of MappedRobot::turned.
struct HandTarget {
  std::vector<double> q, qd;  // [rad], [rad/s]
  bool gripper_closed = false;
};

class DeviceMapping {
 public:
  virtual ~DeviceMapping() = default;
  // The robot stands at q now: from here on the device moves it, without a jump. Never called: the
  // offsets of the specification hold; cartesian starts from MappedRobot::stand.
  virtual void begin(const DeviceState& device, const std::vector<double>& q) noexcept = 0;
  // `h` [s] since the last call; velocities are differences of angles that the device has sensed,
  // zero at first and where the device has let go.
  virtual const HandTarget& map(const DeviceState& device, double h) noexcept = 0;
  // The motors' torques for generalised forces on the driven joints of the KVR, about the last
  // map(). Nothing while the clutch is held.
  virtual DeviceForce feel(const DeviceState& device, const std::vector<double>& tau) noexcept = 0;
  // Of a mapping of points: where the stylus leads the robot's point to a goal in the world, device
  // axes [m]; about the last begin() or map().
  virtual std::optional<Vector3> stylus_for(const Vector3& /*goal_W*/) const noexcept {
    return std::nullopt;
  }
  // What can be felt and what cannot, for people.
  virtual std::string force_feedback_description() const = 0;
};

// Joints beyond a range are put back into it, where it has one. Throws InputError for numbers that
// are none, and for a robot that the mapping cannot move: joints that have not one degree of
// freedom, more than three of them for a joint mapping, a point that none of them moves.
std::unique_ptr<DeviceMapping> make_mapping(const MappingSpec& spec, const OmniParameters& omni,
                                            const MappedRobot& robot);

}  // namespace twinarm
