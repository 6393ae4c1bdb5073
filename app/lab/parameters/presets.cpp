#include "app/lab/parameters/presets.h"

#include <algorithm>

namespace twinarm {

// Gains, step and masses stand in the scenes: those of `twinarm study` (assets/study), which a test
// compares.
const std::vector<Preset>& all_presets() {
  static const std::vector<Preset> presets{
      {"E1", "the paper's E1: torsional coupling, moved by hand", "study_e1.toml", {}, "drag"},
      {"E2", "the paper's E2: linear coupling, moved by hand", "study_e2.toml", {}, "drag"},
      {"E3", "the paper's E3: torsional coupling, automatic motion", "study_e3.toml", {}, "scene"},
      {"E4", "the paper's E4: linear coupling, automatic motion", "study_e4.toml", {}, "scene"}};
  return presets;
}

const Preset* find_preset(const std::string& name) {
  const auto& all = all_presets();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Preset& p) { return p.name == name; });
  return found == all.end() ? nullptr : &*found;
}

void write_presets(JsonWriter& json) {
  json.list(all_presets(), [&](const Preset& preset) {
    json.object({{"name", preset.name}, {"what", preset.what}});
  });
}

}  // namespace twinarm
