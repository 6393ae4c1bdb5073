// A run taken step by step: simulation, ledgers, samples, checkpoints. run_plan() drives it to its
// end, the lab for as long as somebody watches.
//
// Times are those of the grid n h where the run stands on it, which a run from its start does; a
// run that was taken up elsewhere (another step length before) goes on from there by h at a time.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/run/run.h"
#include "app/scene/forces/add_contacts.h"
#include "app/scene/forces/given_forces.h"
#include "app/scene/forces/reported_forces.h"

namespace twinarm {

class SteppedRun final : public RunView {
 public:
  // All must outlive it; `outside` may be null. `from`: goes on there, with the same bits where
  // nothing has changed. Throws InputError where its memory is of another scene.
  SteppedRun(const SimulateInput& simulated, const RunPlan& plan, const RunWatch& watch,
             const RunStart* from = nullptr, OutsideForce* outside = nullptr);

  // The rows of the ledger go on from these, whatever the change of a gain has made of the energy
  // in its spring: of a run that was taken up with other numbers.
  void keep_books(const std::vector<EnergyRow>& told);
  // What watchers see before the first step.
  void begin();
  // One step, or substep of an adaptive integrator. False where the run goes on no more: at its
  // end, and where it has stopped by itself (result().post_mortem) or was interrupted.
  bool advance();
  double time() const { return result_.end; }  // of the last good state [s]
  // So far; without ledgers.
  const SimulateResult& result() const { return result_; }
  // With all that a run leaves behind. Once, at the end.
  SimulateResult finish();

  long step() const override { return result_.steps; }
  const Simulation& simulation() const override { return sim_; }
  const SceneContacts* contacts() const override { return contacts_ ? &*contacts_ : nullptr; }
  std::vector<EnergyRow> ledger() const override;
  std::vector<EnergyRow> hand() const override { return ledger_->hand(); }
  std::vector<MomentumRow> momentum() const override {
    return momentum_->rows(sim_, contacts(), outside_);
  }
  std::string memory() override;

 private:
  void add_forces(const SimulateInput& simulated);
  void warn(std::string text);
  void serialize(StateArchive& memory);
  void take_back(const std::string& bytes);
  void go_on_from(const RunStart& start);
  double time_after(double t, double h) const;
  // One step from t by at most h_most. False where the run stops.
  bool one_step(double t, double h_most);
  void book(const StepReport& report, double t, bool by_limits);
  void look_at_ledger();
  bool stays_bounded(const StepReport& report);
  // Samples before t_end, by side steps from `from`, which stands at t.
  void sample_up_to(double t_end, double t, const Simulation& from);
  State<double> step_aside(const Simulation& from, double h, double t);
  bool stop_for_interrupt(double t) const;

  const RobotInput& input_;
  const RunPlan& plan_;
  const RunWatch& watch_;
  OutsideForce* outside_;
  SimulateResult result_;
  Simulation sim_;
  GivenTorques torques_;
  std::vector<GivenWrench> wrenches_;
  LimitWatch limits_;
  std::optional<EnergyBalance> ledger_;
  std::optional<MomentumBalance> momentum_;
  std::optional<EnergyAlarm> alarm_;
  std::optional<SceneContacts> contacts_;
  std::optional<Simulation> before_;  // the run at the start of the step
  std::vector<State<double>> inner_;
  std::vector<EnergyRow> carried_;  // added to the rows of these names; together nothing
  std::size_t next_ = 0;            // sample
  long unsolved_ = 0, unlocated_ = 0, last_step_ = std::numeric_limits<long>::max();
  bool on_grid_ = true;
  double bound_ = 0;
  std::string earlier_, later_;  // checkpoints
};

}  // namespace twinarm
