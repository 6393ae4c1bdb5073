#include "app/study/study_robot.h"

#include <algorithm>
#include <numbers>

#include "collision/import/robot/robot_model.h"
#include "coupling/analysis/prediction.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

// Links outward of a joint, its own link included.
std::vector<std::string> links_outward(const RobotDescription& robot, const std::string& joint) {
  std::vector<std::string> links;
  for (const JointDescription& j : robot.joints)
    if (j.name == joint) links.push_back(j.child);
  for (std::size_t n = 0; n < links.size(); ++n)
    for (const JointDescription& j : robot.joints)
      if (j.parent == links[n]) links.push_back(j.child);
  return links;
}

// One implicit spring-damper on a joint's coordinate, from frequency and damping ratio on the
// inertia that the joint feels with all others locked.
CouplingSpec joint_hold(const Model<double>& model, const std::string& joint, double frequency_hz,
                        double damping_ratio) {
  const int body = model.find_joint(joint);
  const auto dof = static_cast<Eigen::Index>(model.iv[static_cast<std::size_t>(body)]);
  const double I = mass_matrix(model, State<double>(model))(dof, dof);
  const double w = 2 * std::numbers::pi * frequency_hz;
  CouplingSpec spec;
  spec.name = joint;
  spec.measure = Measure::joint;
  spec.treatment = Treatment::implicit;
  spec.springs = {{joint, body, Vector3::Zero(), I * w * w, 2 * damping_ratio * I * w}};
  return spec;
}

}  // namespace

StudyRobot StudyRobot::s103(const StudySettings& settings, const RobotDescription& description,
                            double arm2_mass_scale) {
  StudyRobot robot;
  robot.name_ = description.name;
  robot.joints_ = settings.joints;
  robot.mounts_ = settings.mounts;
  ModelOptions options;
  for (const std::string& link : links_outward(description, settings.joints.turned.at(1)))
    options.mass_scale[link] = arm2_mass_scale;
  robot.plain_ = options;
  robot.kvr_model_ = robot.dvr_plain_ = build_model(description, options);
  for (const Mount& mount : settings.mounts)
    options.added_masses.push_back({mount.link, mount.p_L, settings.added_mass});
  robot.weighted_ = options;
  robot.dvr_weighted_ = build_model(description, options);

  for (const std::string& joint : {settings.joints.turned.at(2), settings.joints.gripper})
    robot.auxiliary_.push_back(joint_hold(robot.dvr_plain_, joint, settings.auxiliary_frequency_hz,
                                          settings.auxiliary_damping_ratio));
  robot.stops_ = {{robot.kvr_model_.find_joint(settings.joints.gripper),
                   settings.joints.gripper_open, settings.joints.gripper_closed,
                   settings.stop_stiffness, settings.stop_damping}};
  return robot;
}

StudyRobot StudyRobot::findings(const RobotDescription& description) {
  StudyRobot robot;
  robot.name_ = description.name;
  robot.joints_.turned = {"joint1", "joint2"};
  robot.kvr_model_ = robot.dvr_plain_ = robot.dvr_weighted_ = build_model(description);
  for (const std::string& joint : robot.joints_.turned)
    for (const JointDescription& j : description.joints)
      if (j.name == joint)
        for (const LinkDescription& link : description.links)
          if (link.name == j.child) robot.mounts_.push_back({link.name, link.com});
  return robot;
}

std::vector<Spring> StudyRobot::springs(double k1, double b1, double k2, double b2) const {
  const auto body = [&](std::size_t m) { return kvr_model_.find_body(mounts_.at(m).link); };
  return {{"joint1", body(0), mounts_[0].p_L, k1, b1}, {"joint2", body(1), mounts_[1].p_L, k2, b2}};
}

State<double> StudyRobot::start_state() const {
  State<double> x(kvr_model_);
  const auto set = [&](std::size_t j, double q) {
    x.q[kvr_model_.iq[static_cast<std::size_t>(kvr_model_.find_joint(joints_.turned[j]))]] = q;
  };
  set(0, std::numbers::pi / 2);
  set(1, -std::numbers::pi / 4);
  return x;
}

Eigen::Matrix2d StudyRobot::start_inertia(CouplingSpec::Type type) const {
  return mass_matrix(dvr_model(type), start_state()).topLeftCorner<2, 2>();
}

}  // namespace twinarm
