// What the lab runs: a scene or a robot with copies of all its files, and plans of it with changes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/lab/run/scene_edit.h"
#include "app/record/unpack.h"
#include "app/run/simulate_input.h"

namespace twinarm {

class LabScene {
 public:
  // As `twinarm simulate` would run it, without end; options.scene becomes its file. `roots`:
  // folders of files that changes may name, beside its own. Throws InputError with all faults.
  explicit LabScene(const SimulateOptions& options, FileRoots roots = {});
  // The scene of a recording.
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
  bool is_scene() const;
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
