// Makers of parameters, by group. Internal to app/lab/parameters.
#pragma once

#include "app/lab/parameters/parameters.h"
#include "app/scene/read/scene_keys.h"

namespace twinarm::parameter_makers {

LabParameter slider(std::string path, const SliderRow& row, double value, std::string unit,
                    std::string group = "");
LabParameter choice(std::string path, std::string label, std::string value,
                    std::vector<std::string> choices, std::string description);
inline std::string item(const char* list, std::size_t index, const char* key) {
  return std::string(list) + "[" + std::to_string(index) + "]." + key;
}
// A robot of more has no parameters of joints and links: too many for a page.
inline constexpr std::size_t kManyLinks = 200;
inline bool is_path_part(const std::string& name) {
  return name.find_first_of(".[") == std::string::npos;
}

// Choices of the parameters `step` and `rate` in a scene with held forces: the time between two
// evaluations is a multiple of the step. Each text reads back as the same double.
std::vector<std::string> steps_for_rates(const SceneDescription& scene, double step);
std::vector<std::string> rates_for_step(double rate, double step);

void add_couplings(const SceneDescription& scene, const RunPlan& run,
                   std::vector<LabParameter>& parameters);
void add_surfaces(const SceneModel& model, std::vector<LabParameter>& parameters);
void add_joints(const SceneModel& model, std::vector<LabParameter>& parameters);
void add_masses(const SceneDescription& scene, std::vector<LabParameter>& parameters);

}  // namespace twinarm::parameter_makers
