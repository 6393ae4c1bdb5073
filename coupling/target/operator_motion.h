// The hand: six joint angles of a Phantom Omni and its stylus buttons, as functions of time.
//
// A source is asked for the angle AND its rate at a time t, seen from the side of another time
// `toward`: motions with corners have two rates at a corner, and a step belongs to one side of it.
#pragma once

#include <array>
#include <string>

namespace twinarm {

struct HandSample {
  std::array<double, 6> theta{};      // device joints theta1..theta6 [rad]
  std::array<double, 6> theta_dot{};  // [rad/s]
  bool button = false;                // the first: closes the gripper
  bool clutch = false;                // the second: lets go of the robot
};

// The paper's mapping from device to robot: theta1, theta4, theta6 of the Phantom Omni turn joints
// 1, 2, 3 of the robot (its Figures 2, 3); the stylus button moves the gripper.
//
// The paper gives no gain. theta1 of the device reaches +-0.98 rad (56 degrees), the robot's joint
// 1 sweeps +-90 degrees, so joint 1 has gain 2; joints 2 and 3 have gain 1. Assumed.
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

class HandSource {
 public:
  virtual ~HandSource() = default;
  virtual HandSample sample(double t, double toward) const = 0;
  virtual double duration() const = 0;          // [s]
  virtual std::string description() const = 0;  // one line for the report
};

}  // namespace twinarm
