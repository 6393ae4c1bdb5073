// Mapping from an input device to the target robot, and of the force back
// (docs/understand/haptic_rendering.md).
//
//   paper      theta1, theta4, theta6 of the device move joints 1, 2, 3 of the
//              robot. Only theta1 has a motor: force feedback
//              of joint 1 only.
//   arm        theta1, theta2, theta3 move joints 1, 2, 3: force feedback of all three.
//   cartesian  the stylus' point moves a point of the robot by inverse kinematics: feedback of the
//              force on that point.
//
// Joint mappings: q_j = offset_j + gain_j theta_d(j), so by virtual work the motor torque is gain_j
// tau_j, times `force_scale`: a mapping that amplifies motion also amplifies force. While the
// clutch (second button) is pressed, the target stays and the device moves freely; after its
// release the motion continues without a jump. A device that is not alive or has values that are
// not finite is treated like a pressed clutch.
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

// OperatorMapping: for joint mappings; `arm` has its own device joints.
struct MappingSpec : OperatorMapping {
  MappingKind kind = MappingKind::paper;
  // cartesian: the robot's point follows p_start + scale (stylus - stylus at the start), world
  // axes. Default: workspace of 16 cm, reach of the robot 60 cm.
  double scale = 4.0;
  // cartesian: maximum joint speed near singularities [rad/s, m/s].
  double fastest = 20;
  double force_scale = 1.0;
};

// The driven joints of the target robot, and the point that follows the stylus.
struct MappedRobot {
  const Model<double>* model = nullptr;  // must outlive the mapping
  State<double> rest;                    // positions of the other joints
  std::vector<int> turned;               // bodies of the driven joints
  std::vector<double> lower, upper;      // their ranges [rad, m]; empty: none
  int body = 0;                          // cartesian: the point's body
  Vector3 p_L = Vector3::Zero();         // cartesian: the point, link frame [m]
};

// By velocity of the model: index of the driven joint that moves it, or -1, and the ratio (mimic
// joints).
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

// Commanded target, by joint of MappedRobot::turned.
struct MappedTarget {
  std::vector<double> q, qd;  // [rad], [rad/s]
  bool gripper_closed = false;
};

class DeviceMapping {
 public:
  virtual ~DeviceMapping() = default;
  // Continues from q without a jump. If never called, the specified offsets apply; cartesian starts
  // from MappedRobot::rest.
  virtual void begin(const DeviceState& device, const std::vector<double>& q) noexcept = 0;
  // `h`: time since the last call [s]. Velocities are backward differences, zero after an
  // interruption.
  virtual const MappedTarget& map(const DeviceState& device, double h) noexcept = 0;
  // Motor torques for joint forces tau on the driven joints of the target robot, after map(). Zero
  // while the clutch is pressed.
  virtual DeviceForce motor_torques(const DeviceState& device,
                                    const std::vector<double>& tau) noexcept = 0;
  // cartesian: stylus position (device axes) that moves the robot's point to goal_W [m], after
  // begin() or map().
  virtual std::optional<Vector3> stylus_for(const Vector3& /*goal_W*/) const noexcept {
    return std::nullopt;
  }
  virtual std::string force_feedback_description() const = 0;
};

// Joint positions are clamped to the ranges. Throws InputError for values that are not finite,
// joints of several degrees of freedom, more than three joints in a joint mapping, or a point that
// no driven joint moves.
std::unique_ptr<DeviceMapping> make_mapping(const MappingSpec& spec, const OmniParameters& omni,
                                            const MappedRobot& robot);

}  // namespace twinarm
