// What the lab runs: a scene or a robot, with all the files that it needs, so that those on the
// disk may change or vanish; and the same with changes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/record/unpack.h"
#include "app/run/simulate_input.h"

namespace twinarm {

class LabScene {
 public:
  // As `twinarm simulate` would run it; the duration counts for nothing. Throws InputError with all
  // faults.
  // `roots`: where files lie that changes may name, beside its own.
  explicit LabScene(const SimulateOptions& options, FileRoots roots = {});
  // What a recording was of.
  explicit LabScene(RecordingHeader header, FileRoots roots = {});

  // With changes: those of a fork (app/record/unpack.h), and also step, integrator, contact,
  // gravity. The run that it plans has no end, and no sample times. Throws InputError, faults of a
  // change by that change. Files stay readable for as long as a LabScene or a plan of it lives.
  struct Plan {
    SimulatePlan prepared;
    std::shared_ptr<const void> files;
  };
  std::unique_ptr<Plan> plan(const std::vector<Change>& changes = {}) const;

  // The scene with the changes in it, as TOML; empty for a robot alone. Throws InputError.
  std::string text(const std::vector<Change>& changes = {}) const;
  bool is_scene() const;
  // Of a recording of the run with these changes. Some of the couplings, by their places in the
  // scene, may be led by a hand's log (coupling/device/device_motion.h), which goes with it. Throws
  // InputError.
  struct Hand {
    std::vector<std::size_t> couplings;
    std::string log;  // empty: nothing is led
  };
  RecordingHeader header(const std::vector<Change>& changes, const Hand& hand) const;

 private:
  Value tree(const std::vector<Change>& changes) const;
  std::shared_ptr<const UnpackedRun> files_;
  FileRoots roots_;
};

}  // namespace twinarm
