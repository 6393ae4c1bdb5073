// Scenes with changes, run for some steps.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "app/lab/parameters/gallery.h"
#include "app/lab/parameters/parameters.h"
#include "app/record/unpack.h"
#include "app/run/stepped_run.h"
#include "tests/collision/import/robot/helpers.h"

namespace twinarm {

inline SimulatePlan planned(const std::filesystem::path& file,
                            const std::vector<std::string>& changes, long steps = 0) {
  SimulateOptions options;
  options.robot.model = file;
  options.duration = 1;
  options.change_scene = [&](Value& scene, DiagnosticList& faults) {
    for (const std::string& change : changes) apply(parse_change(change), 0, scene, faults);
  };
  SimulatePlan plan = prepare_simulation(options);
  if (steps > 0) plan.run.duration = static_cast<double>(steps) * plan.run.step;
  plan.run.times.clear();
  return plan;
}

struct ShortRun {
  std::string memory;          // all that the next step reads
  double early = 0, late = 0;  // largest speed of a joint in the first tenth, in the last
  bool stopped = false;
  double end = 0;  // [s]
};

inline ShortRun ran(const SimulatePlan& plan, long steps) {
  ShortRun short_run;
  RunWatch watch;
  watch.look = [&](SteppedRun& run) {
    double fastest = 0;
    for (const double v : run.simulation().state().qd) fastest = std::max(fastest, std::abs(v));
    if (run.step() <= steps / 10) short_run.early = std::max(short_run.early, fastest);
    if (run.step() >= steps - steps / 10) short_run.late = std::max(short_run.late, fastest);
    if (run.step() == steps) short_run.memory = run.memory();
  };
  const SimulateResult result = run_plan(plan.input, plan.run, watch);
  short_run.stopped = result.post_mortem.has_value();
  short_run.end = result.end;
  return short_run;
}

inline std::filesystem::path temporary_scene(const std::string& name, const std::string& text) {
  static const TemporaryFolder folder;  // until the program ends
  return folder.write(name + ".toml", text);
}

inline const LabParameter& parameter_at(const std::vector<LabParameter>& parameters,
                                        const std::string& path) {
  for (const LabParameter& parameter : parameters)
    if (parameter.path == path) return parameter;
  throw InputError({{"", 0, path, "no such parameter", "", "test.no-parameter"}});
}

// All scenes of gallery and presets.
inline std::vector<std::filesystem::path> offered_scenes() {
  std::vector<std::filesystem::path> files;
  for (const GalleryScene& scene : read_gallery()) files.push_back(scene.file);
  for (const Preset& preset : all_presets())
    files.push_back(files.front().parent_path() / preset.scene);
  return files;
}

// The S-103 at rest without gravity, held by two springs, with a small disturbance.
inline std::string held_arm(const std::string& top, const std::string& spring) {
  std::string text = "gravity = [0, 0, 0]\n" + top + R"(
[[robot]]
name = "arm"
model = "robots/s103/s103.urdf"
q = { joint1 = 0.3, joint2 = 0.6 }
qd = { joint1 = 1e-6, joint2 = -2e-6 }
lock = ["joint3", "gripper_lift"]
collide = false
)";
  for (const char* where :
       {"link = \"arm1\"\npoint = [0.25, 0, 0.365]", "link = \"arm2\"\npoint = [0.35, 0, 0.1]"})
    text += std::string("[[coupling]]\n") + where + "\n" + spring + "\n";
  return text;
}

}  // namespace twinarm
