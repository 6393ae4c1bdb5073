// The runs that stand beside a run: each a LabRun of its own, that takes the steps
// of the first one's clock, led by the same hand and pulled by the same mouse. What changes the
// scene makes new ones from the last frame of the old, as it does of the run. One thread.
//
// What they did is remembered within the frames of the run: LabFrame::lanes. One that stops by
// itself stays where it is, in all frames that come, while the others go on.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/lab/run/lab_run.h"
#include "app/record/unpack.h"
#include "solver/spatial/pose.h"

namespace twinarm {

// Runs of one scene side by side, on one clock: for each its own value of one path. The first is
// the run itself, that hands, knobs and recordings are about; the others stand beside it
// (variants.h).
struct VariantSet {
  static constexpr std::size_t kMax = 7;  // that colours tell apart

  std::string path;                 // as of a Change: "integrator", "coupling.stiffness"
  std::vector<std::string> values;  // by lane
  std::optional<Vector3> apart;     // from one to the next [m]; none: by the width of the scene

  bool empty() const { return values.empty(); }
  Change change(std::size_t lane) const { return {path, values[lane]}; }
};

// "integrator=semi-implicit,rk4"; commas within brackets are of the value. Throws InputError.
VariantSet parse_lanes(const std::string& text);

// What is wrong with it whatever the scene is; nothing: it may be tried.
struct LaneFault {
  std::string problem, fix;
};
std::optional<LaneFault> fault_of(const VariantSet& lanes);

// Behind all others: changes are applied in their order. One to the same path goes.
void put(std::vector<Change>& changes, const Change& change);

class LabVariants {
 public:
  LabVariants() = default;  // none
  // Plans by lane, from the second on; `from` null: the start. Throws InputError.
  LabVariants(const VariantSet& set, std::vector<std::unique_ptr<LabScene::Plan>> plans,
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
