#include "app/scene/read/read_scene.h"

#include "app/scene/read/scene_keys.h"
#include "app/scene/read/scene_reader.h"
#include "app/support/files.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

// Sorted by line of the scene; those of other files last.
std::vector<Diagnostic> in_order(std::vector<Diagnostic> faults, const std::string& file) {
  std::ranges::stable_sort(faults, [&](const Diagnostic& a, const Diagnostic& b) {
    if ((a.file == file) != (b.file == file)) return a.file == file;
    return a.file == file && a.line < b.line;
  });
  return faults;
}

// Splits "arm/joint1": index of the robot, or of the only one if there is no slash (-1: none), and
// the name in it.
std::pair<int, std::string> robot_and_item(const SceneDescription& scene, const std::string& name) {
  const auto slash = name.find('/');
  const std::string robot = slash == std::string::npos ? "" : name.substr(0, slash);
  const std::string item = name.substr(slash + 1);  // npos + 1 is 0
  if (robot.empty()) return {scene.robots.size() == 1 ? 0 : -1, item};
  const auto found = std::ranges::find(scene.robots, robot, &RobotInScene::name);
  return {found == scene.robots.end() ? -1 : static_cast<int>(found - scene.robots.begin()), item};
}

}  // namespace

SceneDescription read_scene(const std::filesystem::path& file) {
  return read_scene(read_toml(file), file);
}

SceneDescription read_scene(const Value& root, const std::filesystem::path& file,
                            const FileRoots& roots) {
  SceneReader reader;
  reader.path = file;
  reader.file = file.string();
  reader.roots = roots;
  reader.scene.file = file;
  reader.read(root);
  try {
    reader.faults.check();
  } catch (const InputError& error) {
    throw InputError(in_order(error.faults(), reader.file));
  }
  return std::move(reader.scene);
}

void SceneReader::read(const Value& root) {
  TableReader table = open(root, "scene");
  scene.gravity = table.vector("gravity").value_or(scene.gravity);
  scene.step = table.positive("step").value_or(scene.step);
  scene.duration = table.positive("duration");
  scene.accuracy = table.positive("accuracy");
  scene.budget = table.positive("budget").value_or(scene.budget);
  scene.sleep = table.positive("sleep").value_or(scene.sleep);
  if (const auto law = table.choice("contact", kContactModes))
    scene.contact = static_cast<ContactMode>(*law);
  if (const auto detection = table.choice("detection", kDetections))
    scene.detection = static_cast<Detection>(*detection);
  if (const auto chosen = table.choice("integrator", names_of(all_integrators)))
    scene.integrator = all_integrators[*chosen].integrator;

  // Robots and bodies first: the other items refer to them.
  for (const Value* robot : table.tables("robot")) read_robot(*robot);
  for (const Value* body : table.tables("body")) read_body(*body);
  for (const Value* pair : table.tables("pair")) read_pair(*pair);
  std::size_t index = 0;
  for (const Value* coupling : table.tables("coupling")) read_coupling(*coupling, index++);
  index = 0;
  for (const Value* joint : table.tables("constraint")) read_constraint(*joint, index++);
  index = 0;
  for (const Value* spring : table.tables("spring")) read_spring(*spring, index++);
  table.text("note");
  table.done();
  if (faults.empty() && !root.find("robot") && !root.find("body"))
    table.fault("", "has no robots and no bodies",
                "add a [[robot]] or a [[body]] (docs/reference/scene_file.md)", "scene.empty");
}

std::string SceneReader::read_name(TableReader& table, const char* kind) {
  table.missing("name", "give name = \"...\"");
  const std::string name = table.text("name").value_or("");
  if (name.empty()) return name;
  table.rename(std::string(kind) + " '" + name + "'");
  if (name.find('/') != std::string::npos)
    table.fault("name", "must not contain '/', which separates a robot from its link",
                "choose another name", "scene.name");
  if (name == "world")
    table.fault("name", "'world' is reserved", "choose another name", "scene.name");
  if (!taken_names.emplace("body", name).second)
    table.fault("name", "the name is already used", "give each robot and body its own name",
                "scene.name-taken");
  // The links of a single robot have no prefix in the output.
  else if (std::string(kind) == "body" && scene.robots.size() == 1 &&
           find_link(scene.robots[0].description, name))
    table.fault("name", "a link of robot '" + scene.robots[0].name + "' has this name",
                "choose another name", "scene.name-taken");
  return name;
}

ContactSurface SceneReader::read_surface(TableReader& table) {
  ContactSurface surface;
  for (const SurfaceKey& row : surface_keys())
    surface.*row.member = read_number(table, row.key, row.range).value_or(surface.*row.member);
  return surface;
}

Pose SceneReader::read_pose(TableReader& table) {
  Pose pose;
  pose.p = table.vector("position").value_or(pose.p);
  pose.R = table.orientation("orientation").value_or(pose.R);
  return pose;
}

void SceneReader::read_pair(const Value& value) {
  TableReader table = open(value, "pair");
  PairDescription pair;
  pair.line = table.line();
  const auto read_end = [&](const char* key) {
    table.missing(key, "name a body, a robot, or robot/link");
    const std::string name = table.text(key).value_or("");
    if (!name.empty() && (name == "world" || !find_reference(scene, name)))
      table.fault(
          key,
          name == "world" ? "the world has no surface" : "there is no body or robot '" + name + "'",
          name_remedy(name, reference_names(scene), "names"), "scene.unknown-name");
    return name;
  };
  pair.a = read_end("a");
  pair.b = read_end("b");
  for (const SurfaceKey& row : surface_keys())
    if (row.of_pair) pair.*row.of_pair = read_number(table, row.key, row.range);
  pair.collide = table.flag("collide");
  table.done();
  scene.pairs.push_back(std::move(pair));
}

std::optional<std::filesystem::path> SceneReader::find_file(TableReader& table,
                                                            const std::string& key,
                                                            const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  std::vector<fs::path> places{path.parent_path() / name};  // an absolute name is kept
  DiagnosticList no_assets;
  attempt(no_assets, [&] { places.push_back(find_assets() / name); });
  for (const fs::path& place : places)
    if (may_name(roots, place) && fs::is_regular_file(place, ignored))
      return fs::absolute(place).lexically_normal();
  if (roots)  // does not reveal whether the file exists
    table.fault(key, "this scene may not read the file '" + name + "'",
                "upload it before the scene, or name one below assets/", "file.missing");
  else
    table.fault(key, "the file '" + name + "' does not exist",
                "give it absolute, relative to the scene, or below assets/", "file.missing");
  return std::nullopt;
}

std::optional<SceneReference> find_reference(const SceneDescription& scene,
                                             const std::string& name) {
  if (name == "world") return SceneReference{};
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (scene.bodies[b].name == name) return SceneReference{static_cast<int>(b), -1, ""};
  for (std::size_t r = 0; r < scene.robots.size(); ++r)
    if (scene.robots[r].name == name) return SceneReference{-1, static_cast<int>(r), ""};
  const auto [robot, link] = robot_and_item(scene, name);
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
  const auto [robot, joint_name] = robot_and_item(scene, name);
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
