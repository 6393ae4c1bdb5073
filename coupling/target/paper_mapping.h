// The paper's mapping from device to robot: theta1, theta4, theta6 of the Phantom Omni turn joints
// 1, 2, 3 of the robot (its Figures 2, 3); the stylus button moves the gripper.
//
// The paper gives no gain. theta1 of the device reaches +-0.98 rad (56 degrees), the robot's joint
// 1 sweeps +-90 degrees, so joint 1 has gain 2; joints 2 and 3 have gain 1. Assumed.
#pragma once

#include <array>

#include "coupling/target/operator_motion.h"

namespace twinarm {

struct HandMapping {
  std::array<std::size_t, 3> device_joint{0, 3, 5};  // theta1, theta4, theta6
  std::array<double, 3> gain{2.0, 1.0, 1.0};
  std::array<double, 3> offset{0.0, 0.0, 0.0};  // robot angle at theta = 0 [rad]

  double robot_angle(const HandSample& hand, std::size_t joint) const {
    return offset[joint] + gain[joint] * hand.theta[device_joint[joint]];
  }
  double robot_rate(const HandSample& hand, std::size_t joint) const {
    return gain[joint] * hand.theta_dot[device_joint[joint]];
  }
  void set_robot_angle(HandSample& hand, std::size_t joint, double angle, double rate) const {
    hand.theta[device_joint[joint]] = (angle - offset[joint]) / gain[joint];
    hand.theta_dot[device_joint[joint]] = rate / gain[joint];
  }
};

}  // namespace twinarm
