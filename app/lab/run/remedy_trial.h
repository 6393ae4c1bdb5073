// Tries suggested fixes on copies of a run that has stopped, before a user is offered them.
#pragma once

#include "app/diagnose/post_mortem.h"
#include "app/lab/run/lab_inputs.h"

namespace twinarm {

// A stopped run from a frame on.
struct RemedyTrial {
  static constexpr double kHold = 5;        // a fix holds if the run lasts so much longer [s]
  double max_cpu = 4, max_cpu_of_all = 12;  // of a fix, and of all [s]; slower ones are not offered
  static constexpr std::size_t kMaxTried = 10;

  std::shared_ptr<const LabScene> scene;
  std::vector<Change> changes;  // in effect when it stopped
  LabHistory::Frame from;
  std::vector<LabInput> inputs;                                 // since then, ascending
  double stopped_at = 0;                                        // [s]
  OperatorInput::Source source = OperatorInput::Source::scene;  // takes over after the inputs
  LabNames names;
};

// The fixes with which the run from that frame holds: with the same inputs until it stopped, then
// with the source of input, which is not moved (a virtual device is held as by a hand; in place of
// a physical one the target robot rests where the last input left it). In place of a fix that does
// not hold, the further changes are tried that its own run suggests. At most three; best first.
std::vector<SuggestedFix> fixes_that_hold(const RemedyTrial& trial,
                                          const std::vector<SuggestedFix>& suggested,
                                          const std::function<bool()>& is_cancelled);

}  // namespace twinarm
