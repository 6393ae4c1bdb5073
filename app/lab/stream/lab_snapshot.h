// A lab's frame as what there is to be seen of it. The kinematic robot stands where the frame says
// that the hand had it; where no hand leads, where the scene's own targets have it at that time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/lab/run/history.h"
#include "app/page/channels.h"
#include "app/run/simulate_input.h"

namespace twinarm {

class LabMoments {
 public:
  // The plan must outlive it, up to a change. Throws InputError: a trace that cannot be read.
  explicit LabMoments(const SimulatePlan& plan);
  ~LabMoments();
  void change(const SimulatePlan& plan);

  Snapshot at_start();
  Snapshot of(const LabFrame& frame);
  std::vector<Pose> places(const LabFrame& frame) const;  // of bodies alone

  // As the last moment left them; null for a robot alone.
  SceneCouplings* couplings();
  // As a hand can lead them: as in the run (app/lab/run/input_override.h).
  const std::vector<SceneCoupling>& pulls() const;
  std::vector<int> driven() const;  // joints that a hand can drive: the bodies that they carry
  std::optional<std::pair<int, Vector3>> tip() const;  // that it leads, on a body in link axes
  bool follows_device() const;                         // whether the scene says so of a coupling

 private:
  struct OverriddenSource;
  void tell(const LabFrame& frame);

  const SimulatePlan* plan_ = nullptr;
  std::unique_ptr<OverriddenSource> led_;  // null for a robot alone
  double last_time_ = 0;                   // that the kinematic robots have seen
};

// The numbers of a lab's frame, by channel: those of a recorded run, and what the hand, the mouse
// and the clock do.
class LabChannels {
 public:
  // `led`: the scene's couplings as a hand can lead them.
  LabChannels(const SimulateInput& input, const RecordingHeader& header,
              const std::vector<SceneCoupling>& led);
  // Pairs that touch come up as they do, behind all others. True: one did.
  bool add_pairs(const LabFrame& frame);
  // The caller's own, who fills it in; its place.
  std::size_t add(const std::string& name, const std::string& unit, const std::string& kind,
                  const std::string& of) {
    return channels_.add(name, unit, kind, of);
  }
  const std::vector<RunColumn>& all() const { return channels_.all(); }
  void values(const LabFrame& frame, const Snapshot& moment, SceneCouplings* couplings,
              std::vector<double>& values) const;

 private:
  RunChannels channels_;
  std::size_t pull_ = 0, hand_ = 0, time_ = 0;  // places of the first ones
};

}  // namespace twinarm
