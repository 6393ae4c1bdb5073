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

class HandSource {
 public:
  virtual ~HandSource() = default;
  virtual HandSample sample(double t, double toward) const = 0;
  virtual double duration() const = 0;          // [s]
  virtual std::string description() const = 0;  // one line for the report
};

}  // namespace twinarm
