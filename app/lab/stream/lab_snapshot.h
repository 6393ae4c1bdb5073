// Snapshots and channel values of a lab's frames. The target robot is posed as the frame's operator
// input had it, else as the scene's own motion has it at that time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/lab/run/history.h"
#include "app/lab/run/input_override.h"
#include "app/page/channels.h"
#include "app/run/simulate_input.h"

namespace twinarm {

class LabSnapshots {
 public:
  // The plan must outlive it, or its next change(). Throws InputError: unreadable trace.
  explicit LabSnapshots(const SimulatePlan& plan) { change(plan); }
  void change(const SimulatePlan& plan);

  Snapshot at_start();
  Snapshot of(const LabFrame& frame);
  std::vector<Pose> poses(const LabFrame& frame) const;  // of the bodies

  // At the last snapshot; null for a robot alone.
  SceneCouplings* couplings() { return overridden_ ? &overridden_->couplings : nullptr; }
  // Coupling components as the run's operator can drive them.
  const std::vector<SceneCoupling>& components() const;
  const InputOverride* input_override() const {  // null for a robot alone
    return overridden_ ? &overridden_->input : nullptr;
  }

 private:
  struct Overridden {
    Overridden(const SceneModel& of, double h)
        : scene(of), input(&scene, unused, h), couplings(scene, h, nullptr, input.in_place()) {
      input.attach(couplings);
    }
    SceneModel scene;
    OperatorInput unused;
    InputOverride input;
    SceneCouplings couplings;
  };
  void set_targets(const LabFrame& frame);

  const SimulatePlan* plan_ = nullptr;
  std::unique_ptr<Overridden> overridden_;
  double last_time_ = 0;  // that the target robots have evaluated
};

// Values of a frame by channel: those of a recorded run, of the operator input, the mouse spring
// and the timing.
class LabChannels {
 public:
  // `components`: LabSnapshots::components().
  LabChannels(const SimulateInput& input, const RecordingHeader& header,
              const std::vector<SceneCoupling>& components);
  // Appends channels of pairs that are in contact for the first time. True: there was one.
  bool add_pairs(const LabFrame& frame);
  // Appends a channel that the caller fills in; returns its index.
  std::size_t add(const std::string& name, const std::string& unit, const std::string& kind,
                  const std::string& of) {
    return channels_.add(name, unit, kind, of);
  }
  const std::vector<RunColumn>& all() const { return channels_.all(); }
  void values(const LabFrame& frame, const Snapshot& snapshot, SceneCouplings* couplings,
              std::vector<double>& values) const;

 private:
  RunChannels channels_;
  std::size_t mouse_ = 0, hand_ = 0, time_ = 0;  // indices of the first ones
};

}  // namespace twinarm
