#include "collision/import/robot_model.h"

#include <algorithm>

#include "collision/import/robot_check.h"

namespace twinarm {
namespace {

JointType type_of(const JointDescription& joint) {
  switch (joint.type) {
    case JointDescription::Type::fixed:
      return JointType::fixed;
    case JointDescription::Type::revolute:
    case JointDescription::Type::continuous:
      return JointType::revolute;
    case JointDescription::Type::prismatic:
      return JointType::prismatic;
    case JointDescription::Type::floating:
      return JointType::free;
  }
  return JointType::fixed;
}

BodyInertia inertia_of(const LinkDescription& link, const ModelOptions& options) {
  BodyInertia body{link.mass, link.com, link.inertia};
  if (const auto scale = options.mass_scale.find(link.name); scale != options.mass_scale.end()) {
    body.mass *= scale->second;
    body.inertia *= scale->second;
  }
  for (const PointMass& added : options.added_masses)
    if (added.link == link.name && added.mass > 0)
      body = plus_point_mass(body, added.p_L, added.mass);
  return body;
}

}  // namespace

BodyInertia plus_point_mass(const BodyInertia& body, const Vector3& p, double mass) {
  BodyInertia sum;
  sum.mass = body.mass + mass;
  sum.com = (body.mass * body.com + mass * p) / sum.mass;
  const auto shifted = [&](double m, const Vector3& c) -> Matrix3 {
    const Vector3 r = c - sum.com;
    return m * (r.squaredNorm() * Matrix3::Identity() - r * r.transpose());
  };
  sum.inertia = body.inertia + shifted(body.mass, body.com) + shifted(mass, p);
  return sum;
}

Model<double> build_model(const RobotDescription& robot, const ModelOptions& options) {
  ModelBuilder builder;
  const auto link = [&](const std::string& name) -> const LinkDescription& {
    return *std::find_if(robot.links.begin(), robot.links.end(),
                         [&](const LinkDescription& l) { return l.name == name; });
  };
  std::map<std::string, int> body;  // of the links that are added already
  body[robot.root] = builder.add_body(robot.root, 0, robot.root + "_on_world", JointType::fixed, {},
                                      Vector3::UnitZ(), inertia_of(link(robot.root), options));
  for (const std::size_t j : joints_from_root(robot)) {
    const JointDescription& joint = robot.joints[j];
    body[joint.child] =
        builder.add_body(joint.child, body[joint.parent], joint.name, type_of(joint), joint.X_PJ(),
                         joint.axis, inertia_of(link(joint.child), options));
  }
  return builder.build();
}

}  // namespace twinarm
