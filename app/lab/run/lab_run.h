// A run of the lab: one scene with its changes, stepped one by one without end. A changed scene is
// run by a new LabRun, made from the last frame of the old one. Not thread-safe.
#pragma once

#include "app/lab/run/input_override.h"
#include "app/run/stepped_run.h"

namespace twinarm {

class LabRun {
 public:
  // From the scene's start, or from a frame of the same scene with the same or other changes. The
  // frame's checkpoint is restored where its layout fits, bit for bit where nothing was changed;
  // else the run begins at the frame's state with empty energy balance, see restart_reason(). One
  // run at a time may be stepped with the input, which must outlive it. Throws InputError with all
  // faults; the input is then unchanged.
  LabRun(std::unique_ptr<LabScene::Plan> plan, OperatorInput& input,
         const LabFrame* from = nullptr);

  // One step with the present input, or with that of a step of this or another run, bit for bit if
  // that was the same step; live input continues after it without a jump. False: the run has
  // stopped, see post_mortem().
  bool step(const LabInput* replayed = nullptr);
  const LabInput& input() const { return input_; }  // of the last step

  // Mouse spring from a point of a body (link axes) to a goal in the world; a second call with the
  // same point moves the goal. False: no force moves the body.
  bool drag(int body, const Vector3& p_L, const Vector3& goal_W);
  void release_mouse() { mouse_.reset(); }

  // With energy balance, checkpoint and hash; new rows are added to `names`.
  LabFrame frame(LabNames& names);

  // Continues the energy balance of the frame from which the run began.
  void carry_over_energy(const LabFrame& from, const LabNames& names);

  const SimulatePlan& prepared() const { return plan_->prepared; }
  SteppedRun& view() const { return *run_; }
  const InputOverride& input_override() const { return *override_; }
  // Why the checkpoint could not be restored; empty: it was.
  const std::string& restart_reason() const { return restart_reason_; }
  const std::vector<std::string>& warnings() const { return warnings_; }

  // Why it stopped (diverged, energy alarm, kinetic energy beyond its bound), with violations and
  // fixes; null while it runs. `before`: an earlier energy balance, to find the row that grew.
  const PostMortem* post_mortem(const std::vector<EnergyRow>& before = {});

 private:
  void begin(const RunStart* start);
  void restart(const LabFrame& from);

  OperatorInput& operator_;
  std::unique_ptr<LabScene::Plan> plan_;
  RunWatch watch_;
  std::unique_ptr<InputOverride> override_;
  std::unique_ptr<MouseSpring> spring_;
  std::unique_ptr<SteppedRun> run_;
  LabInput input_;
  std::optional<MouseSpringInput> mouse_;  // present input
  std::string restart_reason_;
  bool stopped_ = false;
  double max_energy_ = 0;  // kinetic [J]
  std::vector<std::string> warnings_;
  std::optional<PostMortem> post_mortem_;
};

}  // namespace twinarm
