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

#include <array>
#include <stdexcept>
#include <vector>

#include "solver/impulses/constraint_source.h"
#include "solver/impulses/impulse_solver.h"
#include "solver/impulses/kinematic_trees.h"
#include "solver/integration/integration_state.h"
#include "solver/integration/step_report.h"
#include "solver/support/state_archive.h"

namespace twinarm {

struct ConstraintReport {
  int impacts = 0;             // passes of the first phase
  int wedged = 0;              // of these: what no velocities obey, restitution left out
  ImpulseReport step, impact;  // impact: the worst of its passes
  double impact_loss = 0;      // kinetic energy that impacts took [J]
};

class ConstrainedStep {
 public:
  explicit ConstrainedStep(const Model<double>& model);
  void add(ConstraintSource& source) { sources_.push_back(&source); }
  bool any() const { return !sources_.empty(); }
  const std::vector<ConstraintSource*>& sources() const { return sources_; }
  void set_friction(bool on) { friction_on_ = on; }  // damping and Coulomb friction of joints

  // From m.x, whose m.k is up to date, to the end of the step; begins it for all sources.
  void step(Mechanism& m, double h, StepReport& report);

  // The parts that event_driven_step.h puts together, from m.x with m.k up to date. Velocities
  // alone move.
  void start_report() { report_ = {}; }
  void begin_sources(const Mechanism& m, double h);
  bool hit(Mechanism& m);             // what touches and closes now; false where nothing does
  void flow(Mechanism& m, double h);  // by forces and what is held, over h
  // Residuals [m/s]: of a guess and of a solution that will do, and what a solution aims at.
  void set_accuracy(double good_guess, double accepted, double aim) {
    solver_.good_guess = good_guess, solver_.accepted = accepted, solver_.tolerance = aim;
  }
  std::size_t law_count() const { return problem_.constraints().size(); }  // of the last solution
  void set_usual_accuracy() { set_accuracy(usual_[0], usual_[1], usual_[2]); }
  // Guesses of impulses. Those of loops: none before the first step, then one for each row.
  void forget_loops() { loop_guess_.clear(); }
  void visit_memory(Memory& memory, std::size_t loop_rows) {
    for (auto* guess : {&friction_guess_, &mimic_guess_}) memory.visit_fixed(*guess);
    memory.visit(loop_guess_);
    if (!loop_guess_.empty() && loop_guess_.size() != loop_rows)
      throw std::runtime_error("the loops are not those of this simulation");
    solver_.visit_memory(memory);
  }
  // Loops: J qdd + gamma = 0, the forces of this instant, in place of g' = 0 after the step. A run
  // leaves gamma to the impulses that put velocities right: they cannot give energy.
  void constrain_accelerations() { with_gamma_ = true; }
  const ModelTrees& trees() const { return trees_; }

  const ConstraintReport& report() const { return report_; }
  const std::vector<double>& coulomb_torque() const { return coulomb_; }  // of the last step
  // Generalised force of all constraints, by velocity [N m, N]; without impacts.
  const std::vector<double>& constraint_force() const { return constraint_; }
  // After the impacts of the last step, before its second phase.
  const std::vector<double>& velocities_after_impacts() const { return before_; }

 private:
  static constexpr int most_impacts = 50;
  int resolve_impacts(Mechanism& m, double h, Phase phase);
  void accelerate(Mechanism& m, double h);
  bool turns_alone(const Forces<double>& forces, std::size_t body) const;
  void correct_rotation(Mechanism& m, double h);
  bool solve_step(Mechanism& m, double h, Phase phase);
  bool looks_farther(Mechanism& m, double h);
  void resolve_step(Mechanism& m, double h);
  void move(Mechanism& m, double h);
  void separate(Mechanism& m, double h);
  void add_sources(const ConstraintFrame& frame);
  void keep_velocities(ConstraintFrame& frame);
  void hand_out(const ConstraintFrame& frame);
  void add_joint_friction(const Mechanism& m, double h);
  void add_mimics();
  void add_loops(Mechanism& m, Phase phase, double h);
  void add_bilateral(Mechanism& m, Phase phase, double h = 0);  // both
  void count_bilateral(Mechanism& m, Phase phase);
  double kinetic_energy(const double* v) const;
  double bounce();

  const Model<double>* model_;
  ModelTrees trees_;
  std::vector<ConstraintSource*> sources_;
  std::vector<std::size_t> first_;  // by source: its first constraint in problem_
  ImpulseProblem problem_;
  ImpulseSolver solver_;
  std::array<double, 3> usual_{solver_.good_guess, solver_.accepted, solver_.tolerance};
  ConstraintReport report_;
  bool friction_on_ = true;
  bool with_gamma_ = false;
  std::vector<char> flies_, plastic_;  // by tree
  std::vector<double> before_;         // by velocity: those at the start of the second phase
  std::vector<double> coulomb_, constraint_, shift_;
  std::vector<Vec3<double>> turning_;  // by body: couples of gyroscopic_step.cpp, body axes
  std::vector<double> friction_guess_, mimic_guess_, loop_guess_, sum_, acceleration_, velocity_,
      elastic_, elastic_p_;
  std::size_t first_bilateral_ = 0;  // of the constraints in problem_
  Eigen::VectorXd lambda_;           // impulses of the loops' rows
  State<double> penetrating_;        // before what penetrates is moved apart
};

}  // namespace twinarm
