// Binary frames and history of the run (docs/reference/lab_protocol.md).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/draw/scene_view.h"
#include "app/lab/run/variants.h"
#include "app/lab/stream/lab_snapshot.h"
#include "app/page/page_layers.h"

namespace twinarm {

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
