// The KVR: the kinematic virtual robot, moved by the hand. It has no mass and passes through
// everything; couplings pull the dynamic robot (DVR) after it.
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

// Which joints of a robot the hand moves, by name.
struct DrivenJoints {
  std::vector<std::string> turned;  // by theta1, theta4, theta6, in this order; at most three
  std::string gripper;              // by the button, between open and closed; may be empty
  double gripper_open = 0, gripper_closed = 0;
  bool operator==(const DrivenJoints&) const = default;
};

// Where the KVR's velocity comes from.
enum class TargetRates {
  from_hand,            // the hand's own rate, one-sided at a corner
  backward_difference,  // (q_n - q_n-1) / h of its angles, zero at first: all that a device gives
  none                  // zero: dampers then brake the link's own motion
};

class TargetRobot {
 public:
  // The model and the hand must outlive the robot. Throws InputError for joints that are not there
  // or have not one degree of freedom.
  TargetRobot(const Model<double>& model, const OperatorMotion& hand, const HandMapping& mapping,
              const DrivenJoints& joints, TargetRates rates = TargetRates::from_hand);

  // Where the joints stand that the hand does not move; zero at first. Before the first step.
  void set_pose(const State<double>& x);
  // Looks at the hand for the step [t, t + h]. Asking again for the same step costs nothing.
  void begin_step(double t, double h);
  // The hand has another past now: a step that was looked at is looked at again.
  void forget() { started_ = false; }
  const TargetSample& start() const { return start_; }
  const TargetSample& end() const { return end_; }
  // At a stage within the step, with the velocity of the sweep that the step belongs to.
  const TargetSample& at(double t);

  const OperatorMotion& hand() const { return hand_; }

 private:
  void set(TargetSample& sample, double t, double toward) const;
  // The hand's angles and rates into the sample; false: nothing has changed.
  bool look(TargetSample& sample, double t, double toward) const;
  void pose(TargetSample& sample) const;

  const Model<double>& model_;
  const OperatorMotion& hand_;
  HandMapping mapping_;
  TargetRates rates_;
  std::vector<std::size_t> iq_, iv_;  // of the turned joints
  int gripper_ = -1;                  // body that the gripper joint carries
  double gripper_open_, gripper_closed_;
  TargetSample start_, middle_, end_;
  bool started_ = false;
  std::vector<double> difference_;  // of the last step, by turned joint [rad/s]
};

}  // namespace twinarm
