#include "app/robot/joint_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/support/nearest_name.h"

namespace twinarm {
namespace {

std::vector<std::string> moving_joints(const RobotDescription& robot) {
  std::vector<std::string> names;
  for (const JointDescription& joint : robot.joints)
    if (joint.dofs() > 0 && !joint.mimic) names.push_back(joint.name);
  return names;
}

}  // namespace

void normalise(TableReader& table, const std::string& key, std::span<double, 4> q,
               std::vector<std::string>* warnings) {
  constexpr double kRounding = 1e-15, kSilent = 1e-12;
  const auto length = table.unit_length(key, q);
  if (!length) return;
  if (std::abs(*length - 1) > kRounding)
    for (double& c : q) c /= *length;
  if (warnings && std::abs(*length - 1) > kSilent)
    warnings->push_back(
        fmt::format("{}:{}: {}: the quaternion's length is off by {:.1e}; it was normalised",
                    table.file(), table.find(key)->line, table.where(key), *length - 1));
}

JointValueMap read_joint_values(TableReader& joints, const RobotDescription& robot, JointRows rows,
                                std::vector<std::string>* warnings) {
  JointValueMap found;
  for (const Value& value : joints.value().members) {
    if (joints.is_full()) break;  // each takes a search
    const std::string& name = value.key;
    const auto joint = std::find_if(robot.joints.begin(), robot.joints.end(),
                                    [&](const JointDescription& j) { return j.name == name; });
    if (joint == robot.joints.end()) {
      joints.fault(name, "there is no such joint",
                   name_remedy(name, moving_joints(robot), "joints"), "scene.unknown-name");
    } else if (joint->mimic || joint->dofs() == 0) {
      joints.fault(name,
                   joint->mimic ? "it follows joint '" + joint->mimic->joint + "'"
                                : "it is fixed, and has no coordinate",
                   "leave it out", "scene.no-coordinate");
    } else {
      const bool velocities = rows == JointRows::velocities;
      const std::size_t count = velocities ? joint->facts().nv : joint->facts().nq;
      std::optional<std::vector<double>> numbers;
      if (count > 1)
        numbers = joints.numbers(name, count);
      else if (const auto number = joints.number(name))
        numbers = {*number};
      if (!numbers) continue;
      if (const int first = velocities ? -1 : joint->facts().quaternion; first >= 0)
        normalise(joints, name, std::span<double, 4>(numbers->data() + first, 4), warnings);
      found[name] = {*numbers, value.line};
    }
  }
  return found;
}

}  // namespace twinarm
