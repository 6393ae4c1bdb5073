
#include "app/scene/read/scene_reader.h"
#include "app/support/text.h"
#include "collision/import/formats/robot_formats.h"

namespace twinarm {
namespace {

// Factors on link masses, and point masses on links.
void read_masses(SceneReader& reader, TableReader& table, RobotInScene& robot) {
  const std::vector<std::string> links = names_of(robot.description.links);
  const auto check_link = [&](TableReader& where, const std::string& key, const std::string& name) {
    if (std::ranges::find(links, name) == links.end())
      where.fault(key, "there is no link '" + name + "'", name_remedy(name, links, "links"),
                  "scene.unknown-name");
  };
  if (const Value* scales = table.table("mass_scale")) {
    TableReader factors = reader.open(*scales, table.where() + ", mass_scale");
    for (const Value& value : scales->members) {
      check_link(factors, value.key, value.key);
      if (const auto factor = factors.positive(value.key)) robot.mass_scale[value.key] = *factor;
    }
  }
  for (const Value* value : table.tables("payload")) {
    TableReader payload = reader.open(*value, table.where() + ", payload");
    payload.missing("link", "name its link");
    payload.missing("mass", "give it in kg");
    PointMass mass{payload.text("link").value_or(""),
                   payload.vector("point").value_or(Vector3::Zero()),
                   payload.not_negative("mass").value_or(0)};
    if (!mass.link.empty()) check_link(payload, "link", mass.link);
    payload.done();
    robot.payloads.push_back(std::move(mass));
  }
}

// Replaces the viscous damping of the URDF.
void set_damping(TableReader& table, SceneReader& reader, RobotDescription& robot) {
  JointValueMap given = reader.read_joints(table, "damping", robot, JointRows::velocities);
  for (JointDescription& joint : robot.joints) {
    const auto found = given.find(joint.name);
    if (found == given.end()) continue;
    joint.damping = found->second.values[0];
    if (joint.damping < 0 || joint.dofs() != 1)
      table.fault("damping", "joint '" + joint.name + "' has " + number_text(joint.damping),
                  "give a number >= 0 for a joint of one degree of freedom", "scene.range");
  }
}

// Makes the joint fixed at the position q.
void fix_at(JointDescription& joint, double q) {
  const Matrix3 R = joint.X_PJ().R;
  if (joint.type == JointDescription::Type::prismatic)
    joint.origin.xyz += R * joint.axis * q;
  else if (q != 0)
    joint.origin.turn_to(R * Eigen::AngleAxisd(q, joint.axis).toRotationMatrix());
  joint.type = JointDescription::Type::fixed;
}

}  // namespace

JointValueMap SceneReader::read_joints(TableReader& table, const char* key,
                                       const RobotDescription& robot, JointRows rows) {
  const Value* list = table.table(key);
  if (!list) return {};
  TableReader joints = open(*list, table.where() + ", " + key);
  return read_joint_values(joints, robot, rows, &scene.warnings);
}

void SceneReader::read_robot(const Value& value) {
  TableReader table = open(value, "robot");
  RobotInScene robot;
  robot.line = table.line();
  robot.name = read_name(table, "robot");
  robot.collide = table.flag("collide").value_or(true);
  robot.surface = read_surface(table);
  robot.X_WR = read_pose(table);
  if (const auto base = table.choice("base", {"fixed", "floating"})) robot.floating = *base == 1;
  robot.motion = read_motion(table);
  if (robot.motion && robot.floating)
    table.fault("motion", "conflicts with base = \"floating\"", "leave one of them out",
                "scene.two-keys");
  read_velocities(table, robot, robot.floating, {"the base is fixed", "give base = \"floating\""});

  table.missing("model", "give model = \"robots/.../robot.urdf\"");
  bool readable = false;
  if (const auto model = table.text("model"))
    if (const auto urdf = find_file(table, "model", *model)) {
      RobotFileOptions options;
      options.roots = roots;
      if (!robot.collide) options.geometry = RobotFileOptions::Geometry::optional;
      const auto read = [&] { robot.description = read_robot_file(*urdf, options); };
      readable = attempt(faults, read).has_value();
      for (const Diagnostic& warning : robot.description.warnings)
        scene.warnings.push_back(to_string(warning));
    }
  const bool limits = table.flag("limits").value_or(true);
  if (readable) {
    if (!limits)
      for (JointDescription& joint : robot.description.joints)
        joint.lower = -HUGE_VAL, joint.upper = HUGE_VAL;
    read_masses(*this, table, robot);
    robot.q = read_joints(table, "q", robot.description, JointRows::coordinates);
    robot.qd = read_joints(table, "qd", robot.description, JointRows::velocities);
    robot.torque = read_joints(table, "torque", robot.description, JointRows::velocities);
    set_damping(table, *this, robot.description);
    lock_joints(table, robot);
  } else {
    for (const char* key : {"q", "qd", "torque", "damping", "lock", "mass_scale", "payload"})
      table.find(key);
  }
  table.done();
  scene.robots.push_back(std::move(robot));
}

void SceneReader::lock_joints(TableReader& table, RobotInScene& robot) {
  const Value* list = table.find("lock");
  if (!list) return;
  const auto fault = [&](const std::string& problem, const std::string& fix,
                         std::string_view code) { table.fault("lock", problem, fix, code); };
  if (!list->is_list())
    return fault("must be a list of joints, is " + describe(*list), "write lock = [\"joint1\"]",
                 "scene.type");
  std::vector<JointDescription>& joints = robot.description.joints;
  std::vector<std::string> names;
  for (const JointDescription& joint : joints)
    if (joint.dofs() == 1) names.push_back(joint.name);
  for (const Value& item : list->items) {
    const auto joint = std::ranges::find_if(
        joints, [&](const JointDescription& j) { return item.is_text() && j.name == item.text; });
    const std::string quoted = "joint '" + item.text + "'";
    const auto mimics_it = [&](const JointDescription& j) {
      return j.mimic && j.mimic->joint == item.text;
    };
    if (joint == joints.end())
      fault("there is no joint " + describe(item), name_remedy(item.text, names, "joints"),
            "scene.unknown-name");
    else if (joint->mimic || std::ranges::any_of(joints, mimics_it))
      fault(quoted + " is a mimic joint, or is mimicked", "leave it out", "scene.lock");
    else if (joint->type != JointDescription::Type::revolute &&
             joint->type != JointDescription::Type::continuous &&
             joint->type != JointDescription::Type::prismatic)
      fault(quoted + " is neither revolute nor prismatic", "leave it out", "scene.lock");
    else if (robot.qd.contains(item.text) || robot.torque.contains(item.text))
      fault(quoted + " has a velocity at the start, or a torque",
            "leave it out of qd and torque, or of lock", "scene.lock");
    else {
      const auto q = robot.q.find(item.text);
      fix_at(*joint, q == robot.q.end() ? 0 : q->second.values[0]);
      robot.q.erase(item.text);
    }
  }
}

}  // namespace twinarm
