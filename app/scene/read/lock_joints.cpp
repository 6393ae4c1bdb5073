// lock = ["joint", ..] of a robot: joints that are held where they start, as if they were fixed.
#include <algorithm>
#include <cmath>

#include "app/scene/read/scene_reader.h"
#include "app/support/nearest_name.h"

namespace twinarm {
namespace {

// Of a rotation, as Origin::pose() takes them.
Vector3 fixed_angles(const Matrix3& R) {
  const double pitch = std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0)));
  if (std::hypot(R(0, 0), R(1, 0)) < 1e-12)  // one angle is left to choose
    return {0, pitch, std::atan2(-R(0, 1), R(1, 1))};
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

// The joint's frame as it stands at q.
void fix_at(JointDescription& joint, double q) {
  const Matrix3 R = joint.X_PJ().R;
  if (joint.type == JointDescription::Type::prismatic)
    joint.origin.xyz += R * joint.axis * q;
  else if (q != 0)
    joint.origin.rpy = fixed_angles(R * Eigen::AngleAxisd(q, joint.axis).toRotationMatrix());
  joint.type = JointDescription::Type::fixed;
}

}  // namespace

void SceneReader::lock_joints(TableReader& table, RobotInScene& robot) {
  const Value* list = table.find("lock");
  if (!list) return;
  const auto fault = [&](const std::string& rule, const std::string& remedy,
                         std::string_view code) { table.fault("lock", rule, remedy, code); };
  if (list->kind != Value::Kind::list)
    return fault("must be a list of joints, is " + describe(*list), "write lock = [\"joint1\"]",
                 "scene.type");
  std::vector<JointDescription>& joints = robot.description.joints;
  std::vector<std::string> names;
  for (const JointDescription& joint : joints)
    if (joint.dofs() == 1) names.push_back(joint.name);
  for (const Value& item : list->items) {
    const auto joint = std::find_if(joints.begin(), joints.end(), [&](const JointDescription& j) {
      return item.kind == Value::Kind::text && j.name == item.text;
    });
    const std::string quoted = "joint '" + item.text + "'";
    const auto follows = [&](const JointDescription& j) {
      return j.mimic && j.mimic->joint == item.text;
    };
    if (joint == joints.end())
      fault("there is no joint " + describe(item), name_remedy(item.text, names, "joints"),
            "scene.unknown-name");
    else if (joint->mimic || std::any_of(joints.begin(), joints.end(), follows))
      fault(quoted + " follows another, or another follows it", "leave both as they are",
            "scene.lock");
    else if (joint->type != JointDescription::Type::revolute &&
             joint->type != JointDescription::Type::continuous &&
             joint->type != JointDescription::Type::prismatic)
      fault(quoted + " neither turns nor slides alone", "lock revolute and prismatic joints",
            "scene.lock");
    else if (robot.qd.contains(item.text))
      fault(quoted + " has a velocity at the start", "leave it out of qd, or of lock",
            "scene.lock");
    else {
      const auto q = robot.q.find(item.text);
      fix_at(*joint, q == robot.q.end() ? 0 : q->second.values[0]);
      robot.q.erase(item.text);
    }
  }
}

}  // namespace twinarm
