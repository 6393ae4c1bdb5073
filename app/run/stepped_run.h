// A run step by step: simulation, energy and momentum accounting, samples, checkpoints. run_plan()
// runs it to its end, the lab for as long as a client watches.
//
// Times are those of the grid n h for a run from its start; a run that was resumed with another
// step length continues from there by h at a time.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/run/impact_normals.h"
#include "app/run/run.h"
#include "app/scene/forces/add_contacts.h"
#include "app/scene/forces/given_forces.h"
#include "app/scene/forces/reported_forces.h"

namespace twinarm {

class SteppedRun {
 public:
  // Keeps references to its arguments; `outside` may be null. `from`: resumes there, bit by bit if
  // nothing has changed. Throws InputError if its state is of another scene.
  SteppedRun(const SimulateInput& simulated, const RunPlan& plan, const RunWatch& watch,
             const RunStart* from = nullptr, OutsideForce* outside = nullptr);

  // Continues the energy balance from these rows, after a change of parameters.
  void continue_balance(const std::vector<EnergyRow>& earlier);
  // Calls RunWatch::look before the first step.
  void begin();
  // One step, or substep of an adaptive integrator. False at the end, after a divergence
  // (result().post_mortem) and after an interrupt.
  bool advance();
  double time() const { return result_.end; }               // of the last valid state [s]
  const SimulateResult& result() const { return result_; }  // so far, without balances
  SimulateResult finish();                                  // once, at the end

  long step() const { return result_.steps; }  // number of steps taken
  const Simulation& simulation() const { return sim_; }
  // Null for a URDF.
  const SceneContacts* contacts() const { return contacts_ ? &*contacts_ : nullptr; }
  std::vector<EnergyRow> energy_balance() const;  // `numerical` last
  // Work of the targets since the start.
  std::vector<EnergyRow> input_work() const { return energy_balance_->input_work(); }
  std::vector<MomentumRow> momentum() const { return momentum_->rows(sim_, contacts(), outside_); }
  std::string memory();  // serialized state, from which the run can be resumed

 private:
  void add_forces(const SimulateInput& simulated);
  void warn_of_errors();
  void warn(std::string text);
  void serialize(StateArchive& memory);
  void take_back(const std::string& bytes);
  void go_on_from(const RunStart& start);
  double time_after(double t, double h) const;
  // One step from t by at most h_max. False if the run stops.
  bool one_step(double t, double h_max);
  void book(const StepReport& report, double t, bool by_limits);
  void check_energy_balance();
  bool stays_bounded(const StepReport& report, double bound);
  // Samples before t_end, by side steps from `from`, which is at t.
  void sample_up_to(double t_end, double t, const Simulation& from);
  State<double> step_aside(const Simulation& from, double h, double t);
  bool stop_for_interrupt(double t) const;

  const RobotInput& input_;
  const RunPlan& plan_;
  const RunWatch& watch_;
  OutsideForce* outside_;
  SimulateResult result_;
  Simulation sim_;
  GivenForces given_;
  LimitWatch limits_;
  PosedStates poses_;
  std::optional<EnergyBalance> energy_balance_;
  std::optional<MomentumBalance> momentum_;
  std::optional<EnergyAlarm> alarm_;
  std::optional<SceneContacts> contacts_;
  ImpactNormals impact_normals_;      // since the run was resumed
  std::optional<Simulation> before_;  // the run at the start of the step
  std::optional<Simulation> copy_;    // of side_step()
  std::vector<State<double>> inner_;
  std::vector<EnergyRow> carried_;  // added to the rows of these names; their sum is zero
  std::size_t next_ = 0;            // sample
  long unsolved_ = 0, unlocated_ = 0, last_step_ = std::numeric_limits<long>::max();
  bool on_grid_ = true;
  double bound_ = 0;
  std::string earlier_, later_;  // checkpoints
};

}  // namespace twinarm
