// A run of the lab: one scene with its changes, stepped for as long as somebody watches. What
// changes a scene makes a new LabRun from the last frame of the old one. One thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/lab/run/history.h"
#include "app/lab/run/lab_inputs.h"
#include "app/lab/run/lab_scene.h"
#include "app/run/stepped_run.h"

namespace twinarm {

class InputOverride;
class MouseSpring;

class LabRun {
 public:
  // From the scene's start. The hand must outlive it, and one run at a time is stepped with it.
  // Throws InputError with all faults; the hand is then as before.
  LabRun(const LabScene& scene, const std::vector<Change>& changes, LabHand& hand);
  // From a frame of the same scene with the same or other changes. What the run remembers is taken
  // over where it has the same layout, and goes on with the same bits where nothing was changed;
  // else it begins anew where the frame stands, ledgers at zero: begun_anew() says why.
  LabRun(const LabScene& scene, const std::vector<Change>& changes, LabHand& hand,
         const LabFrame& from);
  // The same with a plan that was made elsewhere; `from` null: the start.
  LabRun(std::unique_ptr<LabScene::Plan> plan, LabHand& hand, const LabFrame* from);
  ~LabRun();

  // One step, moved by the hand as it is now. False: the run goes on no more, see post_mortem().
  bool step();
  // As it was moved before, with the same bits; live input goes on after it without a jump.
  bool step(const LabInput& again);
  const LabInput& input() const { return input_; }  // of the last step

  // A spring from a point of a body (link axes) to a goal in the world. False where no force moves
  // the body. The same body and point again only move the goal.
  bool pull(int body, const Vector3& p_L, const Vector3& goal_W, double stamp);
  void drop();

  double time() const { return run_->time(); }
  long step_count() const { return run_->step(); }
  double step_length() const { return plan_->prepared.run.step; }
  // With ledgers, memory and hash; numbers of rows by `names`, to which new ones are added.
  LabFrame frame(LabNames& names);

  // The ledger goes on from that of the frame that it began at.
  void keep_books(const LabFrame& from, const LabNames& names);

  const SimulatePlan& prepared() const { return plan_->prepared; }
  SteppedRun& view() { return *run_; }
  const std::string& begun_anew() const { return begun_anew_; }  // empty: it was not
  const std::vector<std::string>& warnings() const { return warnings_; }
  // Of the led kinematic robot: joints that a hand drives (bodies that they carry), and where they
  // were told to stand; both empty where no coupling can be led. The point that the hand leads.
  const std::vector<int>& driven() const;
  const std::vector<double>& driven_q() const;
  std::optional<LabHandFrame> hand_frame() const;  // at this instant
  std::optional<std::pair<int, Vector3>> tip() const;
  // The couplings that are led, by their places in the scene.
  std::vector<std::size_t> led() const;
  // Whether the scene itself moves the robot now: a hand that was given back may still be on its
  // way.
  bool scene_leads() const;

  // Why it stopped (by itself, by the ledger's alarm, or as it has far too much energy), with
  // suspects and their remedies; null while it goes on. `before`: the ledger some time before, to
  // tell the row that grew.
  const PostMortem* post_mortem(const std::vector<EnergyRow>& before = {});

 private:
  void start(const LabFrame* from);
  void make_couplings();
  void begin_anew(const LabFrame& from);
  bool take();
  PostMortem stopped_by_energy() const;

  LabHand& hand_;
  std::unique_ptr<LabScene::Plan> plan_;
  RunWatch watch_;
  std::unique_ptr<InputOverride> lead_;
  std::unique_ptr<MouseSpring> pull_;
  std::unique_ptr<SteppedRun> run_;
  LabInput input_;
  std::optional<PullInput> mouse_;  // as it is now
  std::string begun_anew_;
  bool stopped_ = false;
  double max_energy_ = 0;  // kinetic [J]
  std::vector<std::string> warnings_;
  std::optional<PostMortem> post_mortem_;
};

}  // namespace twinarm
