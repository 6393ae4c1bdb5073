// The target robot (KVR, kinematic virtual robot): moved by the operator motion, without mass or
// contacts. Couplings connect the simulated robot (DVR) to it.
#pragma once

#include <vector>

#include "coupling/target/operator_motion.h"
#include "solver/dynamics/kinematics.h"
#include "solver/model/model.h"

namespace twinarm {

struct TargetSample {
  State<double> x;
  Kinematics k;
  explicit TargetSample(const Model<double>& model) : x(model), k(model) {}
};

// Joints that the operator motion drives, by name.
struct DrivenJoints {
  std::vector<std::string> turned;  // by theta1, theta4, theta6, in this order; at most three
  std::string gripper;              // by the button, open or closed; may be empty
  double gripper_open = 0, gripper_closed = 0;
  bool operator==(const DrivenJoints&) const = default;
};

// Source of the KVR's velocity.
enum class TargetRates {
  from_operator,        // the motion's rate, one-sided at a velocity jump
  backward_difference,  // (q_n - q_n-1) / h, zero at first
  none                  // zero: absolute dampers
};

class TargetRobot {
 public:
  // The model and the motion must outlive the robot. Throws InputError for joints that do not exist
  // or have several degrees of freedom.
  TargetRobot(const Model<double>& model, const OperatorMotion& motion,
              const OperatorMapping& mapping, const DrivenJoints& joints,
              TargetRates rates = TargetRates::from_operator);

  // Sets the positions of the joints that are not driven (default: zero), before the first step.
  void set_pose(const State<double>& x);
  // Samples the motion for the step [t, t + h]; a repeated call costs nothing.
  void begin_step(double t, double h);
  // Discards the samples, after a change of the motion.
  void invalidate();
  const TargetSample& start() const { return start_; }
  const TargetSample& end() const { return end_; }
  // At a stage within the step, with one-sided velocities.
  const TargetSample& at(double t);
  // At any t, with velocities on the side of `toward`; a repeated call for t costs nothing.
  const TargetSample& at(double t, double toward);

 private:
  void set(TargetSample& sample, double t, double toward) const {
    if (update(sample, t, toward)) pose(sample);
  }
  // Writes the motion's angles and rates to the sample; false: unchanged.
  bool update(TargetSample& sample, double t, double toward) const;
  void pose(TargetSample& sample) const;

  const Model<double>& model_;
  const OperatorMotion& motion_;
  OperatorMapping mapping_;
  TargetRates rates_;
  std::vector<std::size_t> iq_, iv_;  // of the driven joints
  int gripper_ = -1;                  // body of the gripper joint
  double gripper_open_, gripper_closed_;
  TargetSample start_, middle_, end_;
  bool started_ = false;
  std::vector<double> difference_;  // of the last step, by driven joint [rad/s]
};

}  // namespace twinarm
