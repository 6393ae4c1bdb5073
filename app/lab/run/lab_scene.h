// What the lab runs: a scene or a robot with copies of all its files, and plans of it with changes.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/data/value.h"
#include "app/record/unpack.h"
#include "app/run/simulate_input.h"
#include "app/scene/model/scene_model.h"

namespace twinarm {

// Scenes made in the lab: of a robot file, and with items added to or removed from a scene. All
// changes are to the scene's text, so what is built can be saved as a scene file.

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

class LabScene {
 public:
  // As `twinarm simulate` would run it, without end; options.scene becomes its file. `roots`:
  // folders of files that changes may name, beside its own. Throws InputError with all faults.
  explicit LabScene(const SimulateOptions& options, FileRoots roots = {});
  explicit LabScene(RecordingHeader header, FileRoots roots = {});

  // Changes: those of a branch (app/record/unpack.h), and step, tolerance, integrator, contact,
  // gravity. The planned run has no end and no sample times. Throws InputError; faults of a change
  // name it. Files stay readable while a LabScene or one of its plans exists.
  struct Plan {
    SimulatePlan prepared;
    std::shared_ptr<const void> files;
  };
  std::unique_ptr<Plan> plan(const std::vector<Change>& changes = {}) const;

  // The changed and edited scene. Throws InputError; also for a robot alone.
  std::shared_ptr<const LabScene> edited(const std::vector<Change>& changes,
                                         const SceneEdit& edit) const;

  // The changed scene as TOML; empty for a robot alone. Throws InputError.
  std::string text(const std::vector<Change>& changes = {}) const;
  bool is_scene() const { return files_->header().run.robot.model.extension() == ".toml"; }
  // For a recording of the run with these changes. An operator log
  // (coupling/device/device_motion.h) becomes one of its files and the target of the given
  // couplings. Throws InputError.
  struct Hand {
    std::vector<std::size_t> couplings;  // indices in the scene
    std::string log;                     // empty: none
  };
  RecordingHeader header(const std::vector<Change>& changes, const Hand& hand) const;

 private:
  Value tree(const std::vector<Change>& changes) const;
  std::shared_ptr<const UnpackedRun> files_;
  FileRoots roots_;
};

}  // namespace twinarm
