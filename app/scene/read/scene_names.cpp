#include "app/scene/read/scene_names.h"

namespace twinarm {
namespace {

// "arm/joint1" in two; the robot is empty where there is no stroke.
std::pair<std::string, std::string> robot_and_item(const std::string& name) {
  const auto stroke = name.find('/');
  if (stroke == std::string::npos) return {"", name};
  return {name.substr(0, stroke), name.substr(stroke + 1)};
}

// The index of the robot, or the only one where no name is given; -1 where there is none.
int find_robot(const SceneDescription& scene, const std::string& name) {
  if (name.empty()) return scene.robots.size() == 1 ? 0 : -1;
  for (std::size_t r = 0; r < scene.robots.size(); ++r)
    if (scene.robots[r].name == name) return static_cast<int>(r);
  return -1;
}

}  // namespace

std::optional<SceneReference> find_reference(const SceneDescription& scene,
                                             const std::string& name) {
  if (name == "world") return SceneReference{};
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (scene.bodies[b].name == name) return SceneReference{static_cast<int>(b), -1, ""};
  for (std::size_t r = 0; r < scene.robots.size(); ++r)
    if (scene.robots[r].name == name) return SceneReference{-1, static_cast<int>(r), ""};
  const auto [robot_name, link] = robot_and_item(name);
  const int robot = find_robot(scene, robot_name);
  if (robot < 0 || !find_link(scene.robots[static_cast<std::size_t>(robot)].description, link))
    return std::nullopt;
  return SceneReference{-1, robot, link};
}

std::vector<std::string> reference_names(const SceneDescription& scene) {
  std::vector<std::string> names{"world"};
  for (const BodyDescription& body : scene.bodies) names.push_back(body.name);
  for (const RobotInScene& robot : scene.robots)
    for (const LinkDescription& link : robot.description.links)
      names.push_back(robot.name + "/" + link.name);
  return names;
}

std::optional<JointReference> find_joint(const SceneDescription& scene, const std::string& name) {
  const auto [robot_name, joint_name] = robot_and_item(name);
  const int robot = find_robot(scene, robot_name);
  if (robot < 0) return std::nullopt;
  const auto r = static_cast<std::size_t>(robot);
  for (const JointDescription& joint : scene.robots[r].description.joints)
    if (joint.name == joint_name) return JointReference{r, &joint};
  return std::nullopt;
}

std::string name_in_scene(const SceneDescription& scene, std::size_t robot,
                          const std::string& name) {
  return scene.robots.size() == 1 ? name : scene.robots[robot].name + "/" + name;
}

const JointDescription* own_joint(const RobotDescription& robot, const std::string& link) {
  for (const JointDescription& joint : robot.joints)
    if (joint.child == link && joint.dofs() == 1 && !joint.mimic) return &joint;
  return nullptr;
}

const LinkDescription* find_link(const RobotDescription& robot, const std::string& name) {
  for (const LinkDescription& link : robot.links)
    if (link.name == name) return &link;
  return nullptr;
}

}  // namespace twinarm
