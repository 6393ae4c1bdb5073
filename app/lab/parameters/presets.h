// The paper's four experiments, one click each: a scene of the gallery and what is changed in it.
#pragma once

#include <string>
#include <vector>

#include "app/data/json_writer.h"

namespace twinarm {

struct Preset {
  std::string name, what;            // "E3", one line
  std::string scene;                 // file below assets/scenes/
  std::vector<std::string> changes;  // PATH=VALUE, after the scene is opened; may be empty
  // Who moves the robot then: "scene" (the motion in the file), or "drag" (the hand on the page).
  std::string hand = "scene";
};

const std::vector<Preset>& all_presets();
const Preset* find_preset(const std::string& name);  // nullptr where there is none

// The list `presets` of docs/lab_protocol.md.
void write_presets(JsonWriter& json);

}  // namespace twinarm
