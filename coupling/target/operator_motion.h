// The hand: six joint angles of a Phantom Omni and its stylus buttons, as functions of time.
//
// A source is asked for the angle AND its rate at a time t, seen from the side of another time
// `toward`: motions with corners have two rates at a corner, and a step belongs to one side of it.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>

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

class OperatorMotion {
 public:
  virtual ~OperatorMotion() = default;
  virtual HandSample sample(double t, double toward) const = 0;
  virtual double duration() const = 0;          // [s]
  virtual std::string description() const = 0;  // one line for the report
};

// The paper's automatic motion (section Experiments): robot joint 1 from 90 to -90 degrees and
// joint 2 from -45 to 45 degrees, at once, linearly in time; back; and the first sweep again. The
// speed jumps at every end. Expressed as device angles, so that it takes the same way as a hand.
class AutomaticMotion final : public OperatorMotion {
 public:
  // sweep_time [s] of one sweep, 1 s in the paper.
  AutomaticMotion(const HandMapping& mapping, double sweep_time = 1.0, int sweeps = 3);
  HandSample sample(double t, double toward) const override;
  double duration() const override { return sweep_time_ * sweeps_; }
  std::string description() const override;

 private:
  HandMapping mapping_;
  double sweep_time_;
  int sweeps_;
};

// Another hand, seen late and played faster: sample(t) is that of s = speed (t - delay); before the
// delay has passed it is the start of the motion, at rest. A real delay: no number of steps.
//
// The velocity is the other hand's own at s, times the speed (d/dt of what is seen), and zero
// before the delay has passed. Whether a step at that instant is before or after it is said by
// `toward`, as at any other corner.
class DelayedMotion final : public OperatorMotion {
 public:
  // delay >= 0 [s], speed > 0. A hand that is lent must outlive it.
  DelayedMotion(std::unique_ptr<OperatorMotion> hand, double delay, double speed)
      : owned_(std::move(hand)), hand_(*owned_), delay_(delay), speed_(speed) {}
  DelayedMotion(const OperatorMotion& hand, double delay, double speed)
      : hand_(hand), delay_(delay), speed_(speed) {}

  HandSample sample(double t, double toward) const override {
    constexpr double kSame = 1e-9;  // [s]; an instant that a sum of steps meets to rounding
    const double late = t - delay_, late_toward = toward - delay_;
    const bool waits = late < -kSame || (late < kSame && late + late_toward < 0);
    HandSample seen = waits ? hand_.sample(0, 1)
                            : hand_.sample(speed_ * std::max(late, 0.0), speed_ * late_toward);
    for (double& rate : seen.theta_dot) rate *= waits ? 0 : speed_;
    return seen;
  }
  double duration() const override { return delay_ + hand_.duration() / speed_; }
  std::string description() const override {
    return hand_.description() + "; " + std::to_string(delay_) + " s late, " +
           std::to_string(speed_) + " times as fast";
  }

 private:
  std::unique_ptr<OperatorMotion> owned_;
  const OperatorMotion& hand_;
  double delay_, speed_;
};

}  // namespace twinarm
