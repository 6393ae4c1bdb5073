#include "collision/import/robot/robot_model.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "collision/geometry/convex_hull.h"
#include "collision/import/robot/robot_check.h"
#include "collision/mesh_files/mesh_file.h"

namespace twinarm {
namespace {

JointProperties properties_of(const JointDescription& joint) {
  JointProperties properties;
  properties.pitch = joint.pitch / (2 * std::numbers::pi);
  properties.armature = joint.armature;
  properties.damping = joint.damping;
  properties.coulomb_plus = joint.coulomb_plus;
  properties.coulomb_minus = joint.coulomb_minus;
  return properties;
}

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

// The robot with the options applied.
class ConfiguredRobot {
 public:
  ConfiguredRobot(const RobotDescription& robot, const ModelOptions& options) : robot_(robot) {
    for (LinkDescription& link : robot_.links) link_[link.name] = &link;
    for (const auto& [name, factor] : options.mass_scale)
      if (LinkDescription* link = find(name, "mass_scale")) {
        link->mass *= factor;
        link->inertia *= factor;
      }
    for (const PointMass& added : options.added_masses)
      if (LinkDescription* link = find(added.link, "added_masses"); link && added.mass > 0) {
        const BodyInertia sum = plus_point_mass(inertia(*link), added.p_L, added.mass);
        link->has_inertia = true;
        link->mass = sum.mass;
        link->com = sum.com;
        link->inertia = sum.inertia;
      }
    for (JointDescription& joint : robot_.joints) {
      if (!options.armature) joint.armature = 0;
      if (!options.friction) joint.damping = joint.coulomb_plus = joint.coulomb_minus = 0;
    }
    throw_in_line_order(faults_);
  }

  const RobotDescription& robot() const { return robot_; }
  BodyInertia inertia(const std::string& link) const { return inertia(*link_.at(link)); }

 private:
  static BodyInertia inertia(const LinkDescription& link) {
    return {link.mass, link.com, link.inertia};
  }

  LinkDescription* find(const std::string& name, const char* option) {
    const auto found = link_.find(name);
    if (found != link_.end()) return found->second;
    faults_.push_back({robot_.file.string(), 0, option,
                       "'" + name + "' is not a link of this robot", "use the name of a link",
                       "robot.unknown-link"});
    return nullptr;
  }

  RobotDescription robot_;
  std::map<std::string, LinkDescription*> link_;
  std::vector<Diagnostic> faults_;
};

// Adds file and line to the builder's errors, which have names only.
Model<double> build(const ModelBuilder& builder, const RobotDescription& robot, bool kinematic) {
  try {
    return builder.build(kinematic);
  } catch (const InputError& error) {
    const InputError located = error.changed([&](Diagnostic& fault) {
      if (!fault.file.empty()) return;
      fault.file = robot.file.string();
      for (const LinkDescription& link : robot.links)
        if (fault.where == link_called(link.name)) fault.line = link.line;
      for (const JointDescription& joint : robot.joints)
        if (fault.where == joint_called(joint.name)) fault.line = joint.line;
    });
    throw_in_line_order(located.faults());
    throw;
  }
}

}  // namespace

std::string root_joint_name(const RobotDescription& robot, bool floating) {
  std::string name = floating ? "base" : robot.root + "_on_world";
  const auto taken = [&](const JointDescription& joint) { return joint.name == name; };
  while (std::any_of(robot.joints.begin(), robot.joints.end(), taken)) name += "_";
  return name;
}

void add_robot(ModelBuilder& builder, const RobotDescription& description,
               const ModelOptions& options, const std::string& prefix, const Pose& X_WR) {
  const ConfiguredRobot configured(description, options);
  const RobotDescription& robot = configured.robot();
  std::map<std::string, int> body;  // of the links added so far
  const JointType base = options.floating ? JointType::free
                         : options.driven ? JointType::prescribed
                                          : JointType::fixed;
  body[robot.root] = builder.add_body(
      prefix + robot.root, 0, prefix + root_joint_name(robot, options.floating), base,
      base == JointType::fixed ? X_WR : Pose{}, Vector3::UnitZ(), configured.inertia(robot.root));
  for (const std::size_t j : joints_from_root(robot)) {
    const JointDescription& joint = robot.joints[j];
    body[joint.child] = builder.add_body(
        prefix + joint.child, body[joint.parent], prefix + joint.name, joint.joint_type(),
        joint.X_PJ(), joint.axis, configured.inertia(joint.child), properties_of(joint));
  }
  for (const JointDescription& joint : robot.joints)
    if (joint.mimic && joint.dofs() > 0)  // a fixed joint follows nothing
      builder.add_mimic(prefix + joint.name, prefix + joint.mimic->joint, joint.mimic->multiplier,
                        joint.mimic->offset);
}

Model<double> build_model(const RobotDescription& robot, const ModelOptions& options) {
  ModelBuilder builder;
  add_robot(builder, robot, options, "", {});
  return build(builder, robot, options.kinematic);
}

const std::filesystem::path& file_of(const MeshGeometry& geometry) {
  if (geometry.file.empty())
    throw InputError("mesh '" + geometry.name + "'", "its file was not found",
                     "put it at the path in the robot's file", "file.missing");
  return geometry.file;
}

TriangleMesh load_mesh(const MeshGeometry& geometry) {
  TriangleMesh mesh = load_mesh(file_of(geometry), 1.0);
  for (Vector3& vertex : mesh.vertices) vertex = geometry.scale.cwiseProduct(vertex);
  if (geometry.scale.prod() < 0)
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

Shape collision_shape(const ShapeDescription& shape) {
  return std::visit(
      [](const auto& known) -> Shape {
        if constexpr (!std::is_same_v<decltype(known), const MeshGeometry&>) {
          return known;
        } else {
          TriangleMesh mesh = load_mesh(known);
          if (known.convex) return convex_hull(mesh.vertices);
          return MeshShape{std::move(mesh)};
        }
      },
      shape);
}

}  // namespace twinarm
