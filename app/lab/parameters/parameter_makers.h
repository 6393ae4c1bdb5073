// How the knobs of a scene are made, group by group. Only app/lab/parameters includes it.
#pragma once

#include <string>
#include <vector>

#include "app/lab/parameters/parameters.h"
#include "app/scene/read/scene_keys.h"

namespace twinarm::knob_makers {

LabParameter slider(std::string path, const SliderRow& row, double value, std::string unit);
LabParameter choice(std::string path, std::string label, std::string value,
                    std::vector<std::string> choices, std::string meaning);
inline std::string item(const char* list, std::size_t index, const char* key) {
  return std::string(list) + "[" + std::to_string(index) + "]." + key;
}

// Numbers of the choice knobs `step` and `rate` of a scene with held forces: a step is a whole part
// of the time between two evaluations. Each text reads back as the same double.
std::vector<std::string> steps_for_rates(const SceneDescription& scene, double step);
std::vector<std::string> rates_for_step(double rate, double step);

void add_couplings(const SceneDescription& scene, const RunPlan& run,
                   std::vector<LabParameter>& knobs);
// Friction, restitution, stiffness of contacts; masses of bodies and of links.
void add_surfaces(const SceneModel& model, std::vector<LabParameter>& knobs);
void add_masses(const SceneDescription& scene, std::vector<LabParameter>& knobs);

}  // namespace twinarm::knob_makers
