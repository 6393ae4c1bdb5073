// The lab's inspector: one frame, one body, as a `glass` message (docs/understand/articulated_body_algorithm.md).
//
// The frame's memory is put back into a simulation that was built alike, one semi-implicit step is
// taken there to learn by whose name each force acts, and aba() is asked once more with FullTrace:
// what `twinarm inspect` does with a recording. A hand that leads goes on for that step as in the
// one before, and the mouse pulls as it did. Nothing is shared with the thread that runs.
//
// Cost: a step and an aba(); where time stands still also the second ways, O(n^4) at worst.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "app/lab/run/history.h"
#include "app/run/simulate_input.h"

namespace twinarm {

struct InspectRequest {
  std::size_t body = 1;  // of the model; one that is not there is the first
  bool stands = false;   // time stands still: with all bodies' steps of the call, and second ways
  unsigned scene = 0;    // its number, for the page
  const std::vector<std::string>* ledger =
      nullptr;  // names of RecordedFrame::rows; null: no ledger
};

class BodyInspector {
 public:
  // A plan of its own, made of what the run was made of, its changes included; files that it names
  // are read here. Throws InputError as a run would.
  explicit BodyInspector(SimulatePlan plan);
  ~BodyInspector();
  BodyInspector(BodyInspector&&) noexcept;
  BodyInspector& operator=(BodyInspector&&) noexcept;

  // The message, JSON. Never throws for what is in a frame: numbers that are not finite are null,
  // and a frame of another scene gives a message with a warning and no passes.
  std::string message(const LabFrame& frame, const InspectRequest& question);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace twinarm
