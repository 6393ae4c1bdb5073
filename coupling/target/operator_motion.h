// Operator motion: six joint angles of a Phantom Omni and its stylus buttons as functions of time.
//
// sample(t, toward) gives angles and rates at t as one-sided limits from the side of `toward`: at a
// velocity jump a step uses the rate of its side.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "solver/support/number_text.h"

namespace twinarm {

struct OperatorSample {
  std::array<double, 6> theta{};      // device joints theta1..theta6 [rad]
  std::array<double, 6> theta_dot{};  // [rad/s]
  bool button = false;                // first button: closes the gripper
  bool clutch = false;                // second button: disconnects the device from the target robot
};

// The paper's mapping: theta1, theta4, theta6 of the Phantom Omni move joints 1, 2, 3 of the robot
// (Figures 2, 3); the stylus button moves the gripper. Gains are not published. Assumed: 2 for
// joint 1 (theta1 reaches +-0.98 rad, the joint +-90 degrees), else 1.
struct OperatorMapping {
  std::array<std::size_t, 3> device_joint{0, 3, 5};  // theta1, theta4, theta6
  std::array<double, 3> gain{2.0, 1.0, 1.0};
  std::array<double, 3> offset{0.0, 0.0, 0.0};  // robot angle at theta = 0 [rad]

  double robot_angle(const OperatorSample& sample, std::size_t joint) const {
    return offset[joint] + gain[joint] * sample.theta[device_joint[joint]];
  }
  double robot_rate(const OperatorSample& sample, std::size_t joint) const {
    return gain[joint] * sample.theta_dot[device_joint[joint]];
  }
  void set_robot_angle(OperatorSample& sample, std::size_t joint, double angle, double rate) const {
    sample.theta[device_joint[joint]] = (angle - offset[joint]) / gain[joint];
    sample.theta_dot[device_joint[joint]] = rate / gain[joint];
  }
};

class OperatorMotion {
 public:
  virtual ~OperatorMotion() = default;
  virtual OperatorSample sample(double t, double toward) const = 0;
  virtual double duration() const = 0;          // [s]
  virtual std::string description() const = 0;  // one line
};

// The paper's automatic motion (section Experiments): robot joint 1 from 90 to -90 degrees and
// joint 2 from -45 to 45 degrees, simultaneously and linearly in time; back; and the first sweep
// again. The velocity jumps at every end. Expressed as device angles.
class AutomaticMotion final : public OperatorMotion {
 public:
  // sweep_time [s] of one sweep, 1 s in the paper.
  AutomaticMotion(const OperatorMapping& mapping, double sweep_time = 1.0, int sweeps = 3)
      : mapping_(mapping), sweep_time_(sweep_time), sweeps_(sweeps) {}
  OperatorSample sample(double t, double toward) const override;
  double duration() const override { return sweep_time_ * sweeps_; }
  std::string description() const override;

 private:
  OperatorMapping mapping_;
  double sweep_time_;
  int sweeps_;
};

// Another motion with delay and speed factor: sample(t) is that of s = speed (t - delay) with rates
// times `speed`; for t < delay its start at rest. The delay is a time, not a number of steps.
class DelayedMotion final : public OperatorMotion {
 public:
  // delay >= 0 [s], speed > 0. A motion passed by reference must outlive it.
  DelayedMotion(std::unique_ptr<OperatorMotion> motion, double delay, double speed)
      : owned_(std::move(motion)), motion_(*owned_), delay_(delay), speed_(speed) {}
  DelayedMotion(const OperatorMotion& motion, double delay, double speed)
      : motion_(motion), delay_(delay), speed_(speed) {}

  OperatorSample sample(double t, double toward) const override {
    constexpr double kSame = 1e-9;  // rounding of a sum of steps [s]
    const double s = t - delay_, s_toward = toward - delay_;
    const bool waits = s < -kSame || (s < kSame && s + s_toward < 0);
    OperatorSample delayed =
        waits ? motion_.sample(0, 1) : motion_.sample(speed_ * std::max(s, 0.0), speed_ * s_toward);
    for (double& rate : delayed.theta_dot) rate *= waits ? 0 : speed_;
    return delayed;
  }
  double duration() const override { return delay_ + motion_.duration() / speed_; }
  std::string description() const override {
    return motion_.description() + "; " + short_number_text(delay_) + " s delay, " +
           short_number_text(speed_) + " times as fast";
  }

 private:
  std::unique_ptr<OperatorMotion> owned_;
  const OperatorMotion& motion_;
  double delay_, speed_;
};

// A motion that another one can replace at times.
class OverridableMotion final : public OperatorMotion {
 public:
  // Null: not replaced at that time.
  using Substitute = std::function<const OperatorMotion*(double t, double toward)>;
  OverridableMotion(std::unique_ptr<OperatorMotion> own, Substitute substitute)
      : own_(std::move(own)), substitute_(std::move(substitute)) {}
  OperatorSample sample(double t, double toward) const override {
    const OperatorMotion* other = substitute_(t, toward);
    return (other ? *other : *own_).sample(t, toward);
  }
  double duration() const override { return own_->duration(); }
  std::string description() const override { return own_->description(); }

 private:
  std::unique_ptr<OperatorMotion> own_;
  Substitute substitute_;
};

}  // namespace twinarm
