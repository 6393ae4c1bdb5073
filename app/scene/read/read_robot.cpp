#include <algorithm>
#include <limits>

#include "app/scene/read/scene_reader.h"
#include "app/support/nearest_name.h"
#include "collision/import/formats/robot_formats.h"
#include "solver/support/number_text.h"

namespace twinarm {
namespace {

// Masses of links by factors, and particles on links.
void read_masses(SceneReader& reader, TableReader& table, RobotInScene& robot) {
  std::vector<std::string> links;
  for (const LinkDescription& link : robot.description.links) links.push_back(link.name);
  const auto check_link = [&](TableReader& where, const std::string& key, const std::string& name) {
    if (std::find(links.begin(), links.end(), name) == links.end())
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
    payload.missing("link", "name the link that carries it");
    payload.missing("mass", "give it in kg");
    PointMass mass{payload.text("link").value_or(""),
                   payload.vector("point").value_or(Vector3::Zero()),
                   payload.not_negative("mass").value_or(0)};
    if (!mass.link.empty()) check_link(payload, "link", mass.link);
    payload.done();
    robot.payloads.push_back(std::move(mass));
  }
}

void drop_limits(RobotDescription& robot) {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  for (JointDescription& joint : robot.joints) {
    joint.lower = -kNowhere;
    joint.upper = kNowhere;
  }
}

}  // namespace

JointValueMap SceneReader::read_joints(TableReader& table, const char* key,
                                       const RobotDescription& robot, JointRows rows) {
  const Value* list = table.table(key);
  if (!list) return {};
  TableReader joints = open(*list, table.where() + ", " + key);
  return read_joint_values(joints, robot, rows);
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
  for (const auto& [key, velocity] : {std::pair{"linear_velocity", &robot.linear_velocity},
                                      std::pair{"angular_velocity", &robot.angular_velocity}}) {
    *velocity = table.vector(key).value_or(Vector3::Zero());
    if (!robot.floating && !velocity->isZero(0))
      table.fault(key, "the robot stands on the world", "give base = \"floating\"",
                  "scene.key-useless");
  }

  table.missing("model", "give model = \"robots/.../robot.urdf\"");
  bool readable = false;
  if (const auto model = table.text("model"))
    if (const auto urdf = find_file(table, "model", *model)) {
      RobotFileOptions options;
      options.roots = roots;
      if (!robot.collide) options.geometry = RobotFileOptions::Geometry::optional;
      try {
        robot.description = read_robot_file(*urdf, options);
        readable = true;
        for (const Fault& warning : robot.description.warnings)
          scene.warnings.push_back(to_string(warning));
      } catch (const InputError& error) {
        faults.add(error.faults());
      }
    }
  const bool limits = table.flag("limits").value_or(true);
  if (readable) {
    if (!limits) drop_limits(robot.description);
    read_masses(*this, table, robot);
    robot.q = read_joints(table, "q", robot.description, JointRows::coordinates);
    robot.qd = read_joints(table, "qd", robot.description, JointRows::velocities);
    lock_joints(table, robot);
  } else {
    for (const char* key : {"q", "qd", "lock", "mass_scale", "payload"}) table.find(key);
  }
  table.done();
  scene.robots.push_back(std::move(robot));
}

}  // namespace twinarm
