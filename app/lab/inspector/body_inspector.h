// Dynamics of one body at one frame: the message `inspection`
// (docs/understand/articulated_body_algorithm.md).
//
// The frame's checkpoint is restored in a simulation with the same layout, one semi-implicit step
// is taken to attribute forces to their sources, and aba() is evaluated with FullTrace, as `twinarm
// inspect` does for a recording. For that step the operator motion continues at its rate and the
// mouse spring keeps its force. Shares nothing with the run's thread.
//
// Cost: a step and an aba(); while paused also the cross-checks, O(n^4) at worst.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/data/json_writer.h"
#include "app/inspect/report/inspect_output.h"
#include "app/lab/run/history.h"
#include "app/lab/run/input_override.h"
#include "app/run/simulate_input.h"
#include "solver/forces/force_source.h"

namespace twinarm {

struct InspectRequest {
  std::size_t body = 1;                            // of the model; an invalid index means the first
  bool paused = false;                             // adds the call in its order, and cross-checks
  unsigned scene = 0;                              // its number, for the page
  const std::vector<std::string>* rows = nullptr;  // names of RecordedFrame::rows; null: none
};

class BodyInspector {
 public:
  // Takes a plan of the run with its changes. Throws InputError.
  explicit BodyInspector(SimulatePlan plan);
  BodyInspector(const BodyInspector&) = delete;
  BodyInspector& operator=(const BodyInspector&) = delete;

  // JSON. Numbers that are not finite become null; a frame of another scene gives a warning and no
  // passes.
  std::string message(const LabFrame& frame, const InspectRequest& request);

 private:
  MotionReplacement in_place();
  void set_motion(const LabFrame& frame);
  Inspected inspect(const LabFrame& frame);
  void write(JsonWriter& json, const LabFrame& frame, const InspectRequest& request);

  SimulatePlan plan_;
  GivenState given_;  // of the start
  OperatorInput unused_;
  std::optional<InputOverride> override_;
  std::optional<DeviceMotion> motion_;     // none: the scene's own
  std::optional<MouseSpringState> mouse_;  // of the step that led to the frame
  ForceLaw mouse_force_;
  std::optional<SceneInspector> scene_;
};

}  // namespace twinarm
