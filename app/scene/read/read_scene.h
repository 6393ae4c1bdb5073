// Reads a scene file (docs/reference/scene_file.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/data/value.h"
#include "app/scene/read/scene_description.h"
#include "collision/import/robot/file_search.h"

namespace twinarm {

// Throws InputError with ALL faults of the scene and of its robots' files, each with its line.
SceneDescription read_scene(const std::filesystem::path& file);
// The same of a tree that was read, and perhaps changed; `file` as faults name it, and to find the
// files that it names, which must lie in `roots`.
SceneDescription read_scene(const Value& root, const std::filesystem::path& file,
                            const FileRoots& roots = {});

// Who is meant by a name in a scene: "world", a body, "robot/link", a robot.
struct SceneReference {
  int body = -1;     // index in SceneDescription::bodies
  int robot = -1;    // index in SceneDescription::robots
  std::string link;  // of the robot; empty: all of it
  bool is_world() const { return body < 0 && robot < 0; }
};

// Nothing where nobody has that name. Where there is one robot, its links may be named without it.
std::optional<SceneReference> find_reference(const SceneDescription& scene,
                                             const std::string& name);
std::vector<std::string> reference_names(const SceneDescription& scene);

// "robot/joint", or the joint's name where there is one robot; nothing where there is no such.
struct JointReference {
  std::size_t robot;
  const JointDescription* joint;
};
std::optional<JointReference> find_joint(const SceneDescription& scene, const std::string& name);

// Of links and joints in the model, and in what is printed: their own where there is one robot,
// else with the robot's before it.
std::string name_in_scene(const SceneDescription& scene, std::size_t robot,
                          const std::string& name);

// The joint that carries the link, of one degree of freedom of its own; nullptr where it is
// another.
const JointDescription* own_joint(const RobotDescription& robot, const std::string& link);

const LinkDescription* find_link(const RobotDescription& robot, const std::string& name);

}  // namespace twinarm
