// A semi-implicit step under constraints (contacts, limits, locks, dry friction of joints, mimics).
//
//   impacts    while something closes within the step faster than it may without a bounce:
//              M (v+ - v-) = J^T p at the coordinates of the start. What closes leaves with
//              u+ >= -e u-, what touches stays, both under Coulomb friction: touching bodies take
//              part at once (Newton's law, simultaneous), those with a gap between in sequence.
//   velocity   v* = v+ + h ABA(q, v+, forces);   M' (v' - v*) = J^T p,  where gaps g may close:
//              u' >= -g/h. M' has the implicit terms that ABA solved with. Free bodies turn by
//              the gyroscopic moment of their mean velocity (gyroscopic_step.cpp).
//   position   q' = q + h v'; of a body that flies under gravity alone q + h (v + v')/2
//   separate   what penetrates by more than a slop is moved apart,
//              by the smallest motion in the norm of M;
//              velocities do not feel it.
// No step gains energy from its impulses. In an impact Newton's law with friction can (Kane and
// Levinson 1985): then v+ is taken back towards the plastic one, which cannot, until it does not.
// In the second phase p u' <= 0, as gaps only close.
// What is hit may leave faster than it came, and meet within the step what was too far to be found
// for it: where velocities jump, sources look again, and the phase is solved with what they find.
#pragma once

#include <vector>

#include "solver/integration/step_report.h"
#include "solver/stepping/constraint_system.h"
#include "solver/stepping/gyroscopic_step.h"
#include "solver/stepping/impacts.h"

namespace twinarm {

class ConstrainedStep {
 public:
  explicit ConstrainedStep(const Model<double>& model);
  ConstraintSystem& system() { return system_; }
  const ConstraintSystem& system() const { return system_; }

  // From m.x, whose m.k is up to date, to the end of the step; begins it for all sources.
  void step(IntegrationState& m, double h, StepReport& report);

  // The parts that event_driven_step.h puts together, from m.x with m.k up to date. Velocities
  // alone move.
  void start_report() { report_ = {}; }
  bool hit(IntegrationState& m);  // what touches and closes now; false where nothing does
  void flow(IntegrationState& m, double h);  // by forces and what is held, over h

  // Of this instant: BilateralConstraints::constrain_accelerations(), and no gyroscopic couples.
  void constrain_accelerations();
  void serialize(StateArchive& memory, std::size_t loop_rows);

  const ConstraintReport& report() const { return report_; }
  // Of the last step.
  const std::vector<double>& coulomb_torque() const { return system_.friction.torque(); }
  // Generalised force of all constraints, by velocity [N m, N]; without impacts.
  const std::vector<double>& constraint_force() const { return constraint_; }
  // After the impacts of the last step, before its second phase.
  const std::vector<double>& velocities_after_impacts() const { return before_; }

 private:
  bool solve_step(IntegrationState& m, double h, Phase phase);
  bool looks_farther(IntegrationState& m, double h);
  void move(IntegrationState& m, double h);
  void separate(IntegrationState& m, double h);

  const Model<double>* model_;
  ConstraintSystem system_;
  Impacts impacts_;
  GyroscopicCouples couples_;
  ConstraintReport report_;
  bool at_instant_ = false;
  std::vector<char> flies_;     // by tree
  std::vector<double> before_;  // by velocity: those at the start of the second phase
  std::vector<double> constraint_, shift_, sum_;
  State<double> penetrating_;  // before what penetrates is moved apart
};

}  // namespace twinarm
