// The numbers of a lab's frame, by channel: those of a recorded run, and what the hand, the mouse
// and the clock do.
#pragma once

#include <string>
#include <vector>

#include "app/lab/run/lab_frame.h"
#include "app/page/run_channels.h"

namespace twinarm {

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
  void values(const LabFrame& frame, const Moment& moment, SceneCouplings* couplings,
              std::vector<double>& values) const;

 private:
  RunChannels channels_;
  std::size_t pull_ = 0, hand_ = 0, time_ = 0;  // places of the first ones
};

}  // namespace twinarm
