#include "coupling/target/target_robot.h"

#include <cmath>
#include <limits>
#include <utility>

#include "solver/model/mimic.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

TargetRobot::TargetRobot(const Model<double>& model, const OperatorMotion& motion,
                         const OperatorMapping& mapping, const DrivenJoints& joints,
                         TargetRates rates)
    : model_(model),
      motion_(motion),
      mapping_(mapping),
      rates_(rates),
      gripper_open_(joints.gripper_open),
      gripper_closed_(joints.gripper_closed),
      start_(model),
      middle_(model),
      end_(model) {
  DiagnosticList faults;
  const auto find = [&](const std::string& name) {
    const int body = model.find_joint(name);
    if (body < 0)
      faults.add("joint '" + name + "'", "the robot has no such joint",
                 "use the name of a joint of the robot", "target.unknown-joint");
    else if (const std::size_t dofs = model.dofs(static_cast<std::size_t>(body)); dofs != 1)
      faults.add("joint '" + name + "'",
                 "it has " + std::to_string(dofs) + " degrees of freedom, must have one",
                 "use a revolute, prismatic or screw joint", "target.degrees-of-freedom");
    return static_cast<std::size_t>(body < 0 ? 0 : body);
  };
  for (const std::string& name : joints.turned) {
    const std::size_t body = find(name);
    iq_.push_back(model.iq[body]);
    iv_.push_back(model.iv[body]);
  }
  if (!joints.gripper.empty()) gripper_ = static_cast<int>(find(joints.gripper));
  faults.check();
  difference_.assign(iq_.size(), 0.0);
  set_pose(State<double>(model));
}

void TargetRobot::set_pose(const State<double>& x) {
  for (TargetSample* sample : {&start_, &middle_, &end_}) {
    sample->x.q = x.q;
    sample->x.prescribed = x.prescribed;
    sample->x.t = std::numeric_limits<double>::quiet_NaN();
  }
  set(start_, 0, 1);
  set(end_, 0, 1);
}

void TargetRobot::begin_step(double t, double h) {
  if (started_ && start_.x.t == t && end_.x.t == t + h) return;
  if (started_ && end_.x.t == t) std::swap(start_, end_);  // reuse the kinematics
  const bool start_moved = update(start_, t, t + h);
  bool end_moved = update(end_, t + h, t);
  middle_.x.t = std::numeric_limits<double>::quiet_NaN();
  if (rates_ == TargetRates::backward_difference) {
    for (std::size_t j = 0; j < iq_.size(); ++j) {
      difference_[j] = (end_.x.q[iq_[j]] - start_.x.q[iq_[j]]) / h;
      end_moved = end_moved || end_.x.qd[iv_[j]] != difference_[j];
      end_.x.qd[iv_[j]] = difference_[j];
    }
  }
  if (start_moved) pose(start_);
  if (end_moved) pose(end_);
  started_ = true;
}

const TargetSample& TargetRobot::at(double t) {
  if (t == start_.x.t) return start_;
  if (t == end_.x.t) return end_;
  return at(t, 0.5 * (start_.x.t + end_.x.t));
}

const TargetSample& TargetRobot::at(double t, double toward) {
  if (t != middle_.x.t) set(middle_, t, toward);
  return middle_;
}

void TargetRobot::invalidate() {
  started_ = false;
  middle_.x.t = std::numeric_limits<double>::quiet_NaN();
}

bool TargetRobot::update(TargetSample& sample, double t, double toward) const {
  const OperatorSample sampled = motion_.sample(t, toward);
  bool changed = std::isnan(sample.x.t);
  const auto put = [&](double& variable, double value) {
    changed = changed || variable != value;
    variable = value;
  };
  sample.x.t = t;
  for (std::size_t j = 0; j < iq_.size(); ++j) {
    put(sample.x.q[iq_[j]], mapping_.robot_angle(sampled, j));
    if (rates_ == TargetRates::from_operator)
      put(sample.x.qd[iv_[j]], mapping_.robot_rate(sampled, j));
    if (rates_ == TargetRates::backward_difference) put(sample.x.qd[iv_[j]], difference_[j]);
  }
  if (gripper_ > 0)
    put(sample.x.q[model_.iq[static_cast<std::size_t>(gripper_)]],
        sampled.button ? gripper_closed_ : gripper_open_);
  return changed;
}

void TargetRobot::pose(TargetSample& sample) const {
  apply_mimics(model_, sample.x);
  forward_kinematics(model_, sample.x, sample.k);
}

}  // namespace twinarm
