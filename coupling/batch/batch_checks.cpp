#include <cmath>

#include "coupling/batch/batch_run.h"
#include "coupling/batch/merge_fixed_joints.h"

namespace twinarm {
namespace {

bool goes_in_lanes(JointType type) {
  return type == JointType::fixed || type == JointType::revolute || type == JointType::prismatic ||
         type == JointType::screw;
}

void check_model(const Model<double>& model, FaultList& faults) {
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const std::string where = "joint '" + model.joint_name[i] + "'";
    if (!goes_in_lanes(model.joint[i]))
      faults.add(where,
                 std::string("runs side by side have no ") + name_of(model.joint[i]) + " joints",
                 "run the cells one by one");
    for (std::size_t d = model.iv[i]; d < model.iv[i] + model.dofs(i); ++d)
      if (model.coulomb_plus[d] != 0 || model.coulomb_minus[d] != 0)
        faults.add(where, "runs side by side have no Coulomb friction",
                   "run the cells one by one, or leave the friction out");
  }
  for (const Mimic& mimic : model.mimics)
    for (std::size_t i = 1; i < model.parent.size(); ++i)
      if (model.iv[i] == mimic.follower && model.dofs(i) > 0)
        faults.add("joint '" + model.joint_name[i] + "'",
                   "runs side by side have no joints that follow others",
                   "run the cells one by one");
}

bool moves(const Model<double>& model, int body) {
  for (int i = body; i > 0; i = model.parent[static_cast<std::size_t>(i)])
    if (model.joint[static_cast<std::size_t>(i)] != JointType::fixed) return true;
  return false;
}

void check_driven(const Model<double>& model, const std::string& joint, FaultList& faults) {
  const int body = model.find_joint(joint);
  if (body < 0)
    faults.add("joint '" + joint + "'", "the robot has no such joint",
               "name a joint that the hand turns");
  else if (model.dofs(static_cast<std::size_t>(body)) != 1)
    faults.add("joint '" + joint + "'", "the hand moves it, but it cannot move",
               "run the cells one by one, or leave it out");
}

void check_spring(const BatchSetup& setup, std::size_t s, FaultList& faults) {
  const BatchSpring& spring = setup.springs[s];
  const Model<double>& model = *setup.model;
  const std::string where = "spring " + std::to_string(s);
  if (spring.target >= setup.targets.size())
    faults.add(where, "there is no target " + std::to_string(spring.target),
               "name one of the " + std::to_string(setup.targets.size()) + " targets");
  if (spring.type == CouplingSpec::Type::matched)
    faults.add(where, "runs side by side have torsional and linear springs only",
               "run the cells one by one");
  if (spring.body <= 0 || spring.body >= model.body_count() || !moves(model, spring.body))
    faults.add(where, "it pulls at no link that moves", "name a moving link");
  else if (spring.type == CouplingSpec::Type::torsional && spring.measure == Measure::joint &&
           model.dofs(static_cast<std::size_t>(spring.body)) != 1)
    faults.add(where, "it acts at a joint that does not move", "name another link");
}

}  // namespace

std::vector<Fault> batch_faults(const BatchSetup& setup) {
  FaultList faults;
  const Model<double>& model = *setup.model;
  check_model(model, faults);
  if (setup.targets.empty())
    faults.add("targets", "there is no kinematic robot", "give at least one");
  for (const BatchTarget& target : setup.targets) {
    for (const std::string& joint : target.joints.turned) check_driven(model, joint, faults);
    if (!target.joints.gripper.empty()) check_driven(model, target.joints.gripper, faults);
  }
  for (std::size_t s = 0; s < setup.springs.size(); ++s) check_spring(setup, s, faults);
  for (const std::size_t iq : setup.measured)
    if (iq >= model.nq)
      faults.add("measured", "there is no coordinate " + std::to_string(iq),
                 "the robot has " + std::to_string(model.nq));
  if (!(setup.duration > 0) || !std::isfinite(setup.duration))
    faults.add("duration", "is " + std::to_string(setup.duration) + " s",
               "give a positive number of seconds");
  if (!(setup.bound > 0))
    faults.add("bound", "is " + std::to_string(setup.bound), "give a positive bound");
  return faults.faults();
}

}  // namespace twinarm
