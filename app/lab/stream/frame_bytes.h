// One frame of the run in bytes, and what plots need of many (docs/reference/lab_protocol.md).
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

// Kept from frame to frame: nothing is allocated once it is as large as it gets.
struct FrameColumns {
  std::uint32_t scene = 0, number = 0, flags = 0;
  double time = 0, stamp = 0, age = 0;  // [s]
  std::uint64_t step = 0;
  std::vector<double> channels, works;
  // By body: x y z, and the turn as a quaternion x y z w. Not finite: it has none.
  std::vector<float> link, twin;
  InstanceColumns instances;
  std::vector<std::uint16_t> body;
  LabelColumns labels;
  std::vector<std::uint32_t> text_end;
  std::string text;
  std::vector<std::uint32_t> first{0}, first_label{0};  // by layer
  void clear_entries();
  // Closes a layer: what was added since the one before is in it.
  void end_layer();
  // Left out where a browser could do nothing with it.
  void add(const Instance& instance);
  void add(const Label& label);
};

// Where bodies stand; those without a place (a kinematic robot has but its own) are NaN.
void put_places(const std::vector<Pose>& X_WL, std::size_t first, std::size_t end,
                std::vector<float>& places);

std::string frame_bytes(const FrameColumns& frame);

struct HistoryColumns {
  std::uint32_t scene = 0, channel_count = 0, row_count = 0;
  std::vector<double> time, channels, works;  // frame by frame
};
std::string history_bytes(const HistoryColumns& history);

// The lanes of a run (app/lab/run/variants.h) as they are seen: their bodies beside those of the
// run, and of each its joints and energies as channels.
struct ViewVariants {
  VariantSet set;
  std::vector<std::shared_ptr<const SimulatePlan>> plans;  // from the second lane on
};

class VariantViews {
 public:
  // Adds its channels; all that it says of the run itself is the lane's too.
  VariantViews(ViewVariants lanes, const SimulateInput& input, LabChannels& channels);
  void change(std::vector<std::shared_ptr<const SimulatePlan>> plans);
  // Where they stand, by what is of interest of the run, to which it adds them; their names, above
  // what is there at the start.
  void place(const Extent& start, Extent& extent);

  // As they were in that frame of the run.
  void look(const LabFrame& frame);
  // What was looked at; `before`: of the branch that was left, or null.
  void show(const LabFrame* before, Snapshot& moment) const;
  // `run`: the first lane's; `rows`: names of the ledger's.
  void values(const LabFrame& frame, const Snapshot& run, const std::vector<std::string>& rows,
              std::vector<double>& values) const;

 private:
  struct Seen {
    Snapshot moment;
    VariantFrame frame;
  };

  VariantSet set_;
  std::vector<std::shared_ptr<const SimulatePlan>> plans_;
  std::vector<std::unique_ptr<LabMoments>> moments_;
  std::vector<NamedJoint> joints_;
  std::size_t first_channel_ = 0;
  Vector3 apart_ = Vector3::Zero(), above_ = Vector3::Zero();
  std::vector<Seen> seen_;
};

}  // namespace twinarm
