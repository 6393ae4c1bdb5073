// Reads a scene file (docs/reference/scene_file.md).
#pragma once

#include "app/scene/read/scene_description.h"
#include "collision/import/robot/file_search.h"

namespace twinarm {

// Throws InputError with all diagnostics of the scene and of its robots' files.
SceneDescription read_scene(const std::filesystem::path& file);
// The same from a tree; `file` is used in diagnostics and to find the files that the scene names,
// which must be in `roots`.
SceneDescription read_scene(const Value& root, const std::filesystem::path& file,
                            const FileRoots& roots = {});

// What a name in a scene denotes: "world", a body, "robot/link", a robot.
struct SceneReference {
  int body = -1;     // index in SceneDescription::bodies
  int robot = -1;    // index in SceneDescription::robots
  std::string link;  // of the robot; empty: all links
  bool is_world() const { return body < 0 && robot < 0; }
};

// The links of a single robot may be named without the robot.
std::optional<SceneReference> find_reference(const SceneDescription& scene,
                                             const std::string& name);
std::vector<std::string> reference_names(const SceneDescription& scene);

// "robot/joint", or the joint alone if there is one robot.
struct JointReference {
  std::size_t robot;
  const JointDescription* joint;
};
std::optional<JointReference> find_joint(const SceneDescription& scene, const std::string& name);

// Name of a link or joint in model and output: with the prefix "robot/" if there are several
// robots.
std::string name_in_scene(const SceneDescription& scene, std::size_t robot,
                          const std::string& name);

// The parent joint of the link if it has one degree of freedom and is no mimic joint; else nullptr.
const JointDescription* own_joint(const RobotDescription& robot, const std::string& link);

const LinkDescription* find_link(const RobotDescription& robot, const std::string& name);

}  // namespace twinarm
