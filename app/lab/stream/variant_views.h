// The lanes of a run (app/lab/run/variant_set.h) as they are seen: their bodies beside those of the
// run, and of each its joints and energies as channels.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/draw/scene_view.h"
#include "app/lab/run/variant_set.h"
#include "app/lab/stream/lab_channels.h"
#include "app/lab/stream/lab_snapshot.h"

namespace twinarm {

struct ViewLanes {
  LaneSet set;
  std::vector<std::shared_ptr<const SimulatePlan>> plans;  // from the second lane on
};

class LaneViews {
 public:
  // Adds its channels; all that it says of the run itself is the lane's too.
  LaneViews(ViewLanes lanes, const SimulateInput& input, LabChannels& channels);
  void change(std::vector<std::shared_ptr<const SimulatePlan>> plans);
  // Where they stand, by what is of interest of the run, to which it adds them; their names, above
  // what is there at the start.
  void place(const Extent& start, Extent& extent);

  // As they were in that frame of the run.
  void look(const LabFrame& frame);
  // What was looked at; `before`: of the branch that was left, or null.
  void show(const LabFrame* before, Moment& moment) const;
  // `run`: the first lane's; `rows`: names of the ledger's.
  void values(const LabFrame& frame, const Moment& run, const std::vector<std::string>& rows,
              std::vector<double>& values) const;

 private:
  struct Seen {
    Moment moment;
    LaneFrame frame;
  };

  LaneSet set_;
  std::vector<std::shared_ptr<const SimulatePlan>> plans_;
  std::vector<std::unique_ptr<LabMoments>> moments_;
  std::vector<NamedJoint> joints_;
  std::size_t first_channel_ = 0;
  Vector3 apart_ = Vector3::Zero(), above_ = Vector3::Zero();
  std::vector<Seen> seen_;
};

}  // namespace twinarm
