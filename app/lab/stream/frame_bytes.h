// Binary frames and history of the run (docs/reference/lab_protocol.md).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/lab/run/history.h"
#include "app/lab/run/input_override.h"
#include "app/lab/run/variants.h"
#include "app/page/channels.h"
#include "app/page/page_layers.h"
#include "app/run/simulate_input.h"

namespace twinarm {

// Snapshots and channel values of a lab's frames. The target robot is posed as the frame's operator
// input had it, else as the scene's own motion has it at that time.

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
class LabChannels : public RunChannels {
 public:
  // `components`: LabSnapshots::components().
  LabChannels(const SimulateInput& input, const RecordingHeader& header,
              const std::vector<SceneCoupling>& components);
  // Appends channels of pairs that are in contact for the first time. True: there was one.
  bool add_pairs(const LabFrame& frame);
  void values(const LabFrame& frame, const Snapshot& snapshot, SceneCouplings* couplings,
              std::vector<double>& values) const;

 private:
  std::size_t mouse_ = 0, hand_ = 0, time_ = 0;  // indices of the first ones
  std::size_t contacts_ = 0;                     // likewise; 0: none
};

// Reused for all frames, so that nothing is allocated at its full size.
struct FrameColumns {
  std::uint32_t scene = 0, number = 0, flags = 0;
  double time = 0, stamp = 0, age = 0;  // [s]
  std::uint64_t step = 0;
  std::vector<double> channels, works;
  // Poses by body: x y z and the quaternion x y z w; NaN: none.
  std::vector<float> link, target;
  InstanceColumns instances;
  std::vector<std::uint16_t> body;
  LabelColumns labels;
  std::vector<std::uint32_t> text_end;
  std::string text;
  std::vector<std::uint32_t> first{0}, first_label{0};  // by layer
  void clear_entries();
  void end_layer();  // what was added since the last call is in it
  // Instances and labels that are not finite or too far away are left out.
  void add(const Instance& instance);
  void add(const Label& label);
};

// Poses [first, end) as in FrameColumns::link.
void put_poses(const std::vector<Pose>& X_WL, std::size_t first, std::size_t end,
               std::vector<float>& poses);

std::string frame_bytes(const FrameColumns& frame);

struct HistoryColumns {
  std::uint32_t scene = 0, channel_count = 0, row_count = 0;
  std::vector<double> time, channels, works;  // frame by frame
};
std::string history_bytes(const HistoryColumns& history);

// Variants of the run (app/lab/run/variants.h) as shown: bodies beside those of the run; joint
// positions and energies as channels.
struct ViewVariants {
  VariantSet set;
  std::vector<std::shared_ptr<const SimulatePlan>> plans;  // from the second variant on
};

class VariantViews {
 public:
  // Adds its channels; `input`: of the run.
  VariantViews(ViewVariants variants, const SimulateInput& input, LabChannels& channels);
  void change(std::vector<std::shared_ptr<const SimulatePlan>> plans);
  // Chooses their offsets, and label positions above `start`; adds them to the run's extent.
  void place(const Extent& start, Extent& extent);

  // Takes their states of a frame of the run.
  void look(const LabFrame& frame);
  // Adds them to the snapshot; `before`: frame of the run that the branch left, or null.
  void show(const LabFrame* before, Snapshot& snapshot) const;
  // Channel values; `run`: snapshot of the first variant; `rows`: names of the energy balance.
  void values(const LabFrame& frame, const Snapshot& run, const std::vector<std::string>& rows,
              std::vector<double>& values) const;

 private:
  struct Seen {
    Snapshot snapshot;
    VariantFrame frame;
  };

  VariantSet set_;
  std::vector<std::shared_ptr<const SimulatePlan>> plans_;
  std::vector<std::unique_ptr<LabSnapshots>> snapshots_;
  std::vector<NamedJoint> joints_;
  std::size_t first_channel_ = 0;
  Vector3 apart_ = Vector3::Zero(), above_ = Vector3::Zero();
  std::vector<Seen> seen_;
};

}  // namespace twinarm
