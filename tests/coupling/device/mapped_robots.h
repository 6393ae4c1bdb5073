// State of an input device from its joint angles, and robots for mappings.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "collision/import/robot/robot_model.h"
#include "collision/import/urdf/urdf.h"
#include "coupling/device/device_mapping.h"
#include "tests/solver/dynamics/random_tree.h"

namespace twinarm::testing {

inline DeviceState device_at(const OmniParameters& omni, const OmniAngles& theta) {
  DeviceState device;
  device.theta = theta;
  device.stylus.p = omni_position(omni, theta);
  return device;
}
inline OmniAngles random_angles(const OmniParameters& omni, Random& random) {
  OmniAngles theta;
  for (std::size_t j = 0; j < 6; ++j) theta[j] = random.uniform(omni.lower[j], omni.upper[j]);
  return theta;
}

struct MappedModel {
  std::string name;
  Model<double> model;
  MappedRobot robot;
  MappedModel(std::string n, const std::string& urdf, const std::vector<std::string>& joints,
              const std::string& link, const Vector3& p_L)
      : name(std::move(n)) {
    const RobotDescription description = read_urdf(TWINARM_SOURCE_DIR "/assets/robots/" + urdf);
    model = build_model(description);
    robot.model = &model;
    for (const std::string& joint : joints) {
      robot.turned.push_back(model.find_joint(joint));
      for (const auto& j : description.joints)
        if (j.name == joint) {
          robot.lower.push_back(j.lower);
          robot.upper.push_back(j.upper);
        }
    }
    robot.body = model.find_body(link);
    robot.p_L = p_L;
  }
  MappedModel(const MappedModel&) = delete;

  Vector3 point(const std::vector<double>& q) const {
    State<double> x(model);
    for (std::size_t j = 0; j < q.size(); ++j)
      x.q[model.iq[static_cast<std::size_t>(robot.turned[j])]] = q[j];
    Kinematics k(model);
    forward_kinematics(model, x, k);
    return k.position(robot.body, robot.p_L);
  }
  std::vector<double> random_q(Random& random) const {
    std::vector<double> q;
    for (std::size_t j = 0; j < robot.turned.size(); ++j)
      q.push_back(random.uniform(0.7 * robot.lower[j], 0.7 * robot.upper[j]));
    return q;
  }
};

// A planar arm, a redundant planar arm, a spatial arm, and a redundant spatial arm.
inline std::vector<std::unique_ptr<MappedModel>> mapped_robots() {
  std::vector<std::unique_ptr<MappedModel>> all;
  const auto add = [&](auto&&... arguments) {
    all.push_back(std::make_unique<MappedModel>(arguments...));
  };
  using Names = std::vector<std::string>;
  const std::string s103 = "s103/s103.urdf", puma = "puma560/puma560.urdf";
  add("S-103, axis of the quill", s103, Names{"joint1", "joint2", "joint3"}, "quill",
      Vector3(0, 0, 0));
  add("S-103, beside the quill", s103, Names{"joint1", "joint2", "joint3"}, "quill",
      Vector3(0.08, 0, 0));
  add("PUMA 560, wrist", puma, Names{"j1", "j2", "j3"}, "link4", Vector3(0, 0, 0.4318));
  add("PUMA 560, all joints", puma, Names{"j1", "j2", "j3", "j4", "j5", "j6"}, "link6",
      Vector3(0.05, 0, 0.1));
  return all;
}

}  // namespace twinarm::testing
