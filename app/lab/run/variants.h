// The runs that stand beside a run (variant_set.h): each a LabRun of its own, that takes the steps
// of the first one's clock, led by the same hand and pulled by the same mouse. What changes the
// scene makes new ones from the last frame of the old, as it does of the run. One thread.
//
// What they did is remembered within the frames of the run: LabFrame::lanes. One that stops by
// itself stays where it is, in all frames that come, while the others go on.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/lab/run/lab_run.h"
#include "app/lab/run/variant_set.h"

namespace twinarm {

class LabLanes {
 public:
  LabLanes() = default;  // none
  // Plans by lane, from the second on; `from` null: the start. Throws InputError.
  LabLanes(const LaneSet& set, std::vector<std::unique_ptr<LabScene::Plan>> plans,
           const LabFrame* from, const LabNames& names);

  // After each step of the run: all up to its time, by what came from outside in that step.
  void follow(const LabRun& run);
  // To a frame of the run, as they stand; new rows are named.
  void add_to(LabFrame& frame, LabNames& names);
  // Who has stopped since this was asked last, and why: a line each.
  std::vector<std::string> take_words();

 private:
  struct Lane {
    std::string name;
    std::unique_ptr<LabHand> nobody;  // who is led by what the run's hand did needs none
    std::unique_ptr<LabRun> run;      // null: it has stopped, and `last` has been made
    std::shared_ptr<const LabFrame> last;
    bool stopped = false;
  };
  void stop(Lane& lane);

  std::vector<Lane> lanes_;
  std::vector<std::string> words_;
};

}  // namespace twinarm
