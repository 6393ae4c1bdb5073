// Semi-implicit time-stepping with constraints (contacts, limits, locks, joint friction, mimics).
//
//   impacts    while a contact closes within the step fast enough to bounce:
//              M (v+ - v-) = J^T p at the initial coordinates, with Coulomb friction and Newton's
//              restitution u+ >= -e u- of closing contacts. Touching bodies take part
//              simultaneously, bodies with a gap between them in sequence.
//   velocity   v* = v+ + h ABA(q, v+, forces);   M' (v' - v*) = J^T p with u' >= -g/h for gaps g.
//              M' includes the implicit terms of ABA. Free bodies use the gyroscopic moment of
//              their mean velocity (gyroscopic_step.h).
//   sleep      velocities of islands at rest become zero (island_sleep.h), if it is on
//   position   q' = q + h v'; q + h (v + v')/2 for free bodies under gravity alone
//   separation penetration above a tolerance is reduced by the smallest motion in the norm of M,
//              without effect on velocities
// Impulses never increase the energy. Newton's restitution with friction could (Kane and Levinson
// 1985): v+ is then blended towards the inelastic solution, which cannot. In the velocity phase
// p u' <= 0, as gaps can only close.
// A velocity jump can lead to contacts that were beyond the detection margin: detection is then
// extended, and the phase is solved again with the new contacts.
#pragma once

#include <vector>

#include "solver/integration/step_report.h"
#include "solver/stepping/constraint_system.h"
#include "solver/stepping/gyroscopic_step.h"
#include "solver/stepping/impacts.h"
#include "solver/stepping/island_sleep.h"

namespace twinarm {

class ConstrainedStep {
 public:
  explicit ConstrainedStep(const Model<double>& model);
  ConstraintSystem& system() { return system_; }
  const ConstraintSystem& system() const { return system_; }

  // Advances m.x by h; m.k must be up to date. Calls begin_step() of all sources.
  void step(IntegrationState& m, double h, StepReport& report);

  // Parts used by event_driven_step.h, from m.x with m.k up to date; change velocities only.
  void start_report() { report_ = {}; }
  // Of closed gaps; false if there are none.
  bool resolve_impacts_now(IntegrationState& m) {
    return impacts_.resolve(system_, m, 0, Phase::impact_at_event, report_) > 0;
  }
  void smooth_step(IntegrationState& m, double h);  // with the active set of the sources

  // Forces at this instant: BilateralConstraints::constrain_accelerations(), no gyroscopic couples.
  void constrain_accelerations() {
    at_instant_ = true;
    system_.bilateral.constrain_accelerations();
  }
  void serialize(StateArchive& archive, std::size_t loop_rows);

  IslandSleep& sleep() { return sleep_; }
  const IslandSleep& sleep() const { return sleep_; }
  int bodies_asleep() const;

  const ConstraintReport& report() const { return report_; }
  // Of the last step.
  const std::vector<double>& coulomb_torque() const { return system_.friction.torque(); }
  // Generalised force of all constraints without impacts, by velocity [N m, N].
  const std::vector<double>& constraint_force() const { return constraint_; }
  // After the impacts, before the velocity phase.
  const std::vector<double>& velocities_after_impacts() const { return before_; }

 private:
  bool solve_step(IntegrationState& m, double h, Phase phase);
  bool extend_detection(IntegrationState& m, double h);
  void fall_asleep(IntegrationState& m, double h, bool constrained);
  void update_positions(IntegrationState& m, double h);
  void correct_positions(IntegrationState& m, double h);

  const Model<double>* model_;
  ConstraintSystem system_;
  Impacts impacts_;
  GyroscopicCouples couples_;
  IslandSleep sleep_;
  ConstraintReport report_;
  bool at_instant_ = false;
  std::vector<char> is_free_;   // by tree: no constraint impulse
  std::vector<double> before_;  // velocities at the start of the velocity phase
  std::vector<double> constraint_, delta_, sum_;
  State<double> before_change_;  // by sleep or position correction
};

}  // namespace twinarm
