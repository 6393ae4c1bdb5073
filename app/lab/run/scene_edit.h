// Scenes made in the lab: of a robot file, and with items added to or removed from a scene. All
// changes are to the scene's text, so what is built can be saved as a scene file.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "app/data/value.h"
#include "app/scene/model/scene_model.h"

namespace twinarm {

struct SceneEdit {
  // "box", "sphere": dropped above the scene; "floor"; "link-spring": a linear coupling to the
  // kinematic robot at the link's centre of mass; "joint-springs": a torsional one at each joint of
  // one degree of freedom; "remove": the body `name`, with its pairs and constraints.
  static constexpr std::array kNames{"floor",       "box",           "sphere",
                                     "link-spring", "joint-springs", "remove"};
  std::string what;
  std::string name;  // link, or body to remove, as in the output
};

// The robot alone, in a scene beside its file. Links of the robot do not collide with each other;
// without `collide` they do not collide at all (their meshes are not needed then).
Value scene_of_robot(const std::filesystem::path& robot, bool collide);

// Throws InputError: unknown name, or nothing to add. `built`: the same scene.
void apply(const SceneEdit& edit, const SceneModel& built, Value& scene);

}  // namespace twinarm
