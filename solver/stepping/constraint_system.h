// Shared by the phases of a constrained step (constrained_step.h): constraint sources, impulse
// problem and its solver; joint damping and friction.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "solver/constraints/constraint_source.h"
#include "solver/constraints/kinematic_trees.h"
#include "solver/impulses/impulse_solver.h"
#include "solver/integration/integration_state.h"
#include "solver/stepping/bilateral_constraints.h"
#include "solver/support/state_archive.h"

namespace twinarm {

// Damping acts at the end of the step (armature h b). Coulomb friction is a box-constrained impulse
// per dof.
class FrictionConstraints {
 public:
  explicit FrictionConstraints(const Model<double>& model)
      : model_(&model), torque_(model.nv), guess_(model.nv) {}
  void set_on(bool on) { is_on_ = on; }

  void add_dampers(const State<double>& x, double h, Forces<double>& forces) const;
  void add_to(ImpulseProblem& problem, const KinematicTrees& trees, double h);
  // Reads the solution of a step h: joint forces, and initial guesses of the next step.
  void read_impulses(const ImpulseProblem& problem, double h);
  // Sets torque() to zero.
  void clear() { std::fill(torque_.begin(), torque_.end(), 0); }
  const std::vector<double>& torque() const { return torque_; }  // by velocity [N m, N]
  void serialize(StateArchive& archive) { archive.visit_fixed(guess_); }

 private:
  bool has_coulomb(std::size_t dof) const {
    return model_->coulomb_plus[dof] > 0 || model_->coulomb_minus[dof] > 0;
  }
  const Model<double>* model_;
  bool is_on_ = true;
  std::size_t first_ = 0;  // index of the first constraint in the problem
  std::vector<double> torque_, guess_;
};

class ConstraintSystem {
 public:
  explicit ConstraintSystem(const Model<double>& model)
      : trees(model), bilateral(model), friction(model) {}

  KinematicTrees trees;
  std::vector<ConstraintSource*> sources;
  BilateralConstraints bilateral;
  FrictionConstraints friction;
  ImpulseProblem problem;
  ImpulseSolver solver;
  std::vector<double> velocity;  // v0 at store_velocities()

  void begin_step(const IntegrationState& m, double h) {
    if (budget_ > 0 && h > 0) solver.accuracy.budget = budget_ * h;
    for (ConstraintSource* source : sources) source->begin_step(m.k, m.x, h);
  }
  // m.w.qdd at m.x without constraints; m.k must be up to date.
  void accelerate(IntegrationState& m, double h);
  // Starts a problem without constraints; the mass matrix is set before it is solved.
  void begin_problem() {
    problem.clear();
    trees.add_to(problem);
  }
  void store_velocities(ConstraintFrame& frame);  // copies v0 of the problem
  void add_sources(const ConstraintFrame& frame);
  // Passes the solution to the sources.
  void distribute_impulses(const ConstraintFrame& frame) {
    for (std::size_t s = 0; s < sources.size(); ++s)
      sources[s]->read_impulses(frame, problem, first_[s]);
  }

  // Residuals [m/s]: of an accepted guess, of an accepted solution, target of the iteration.
  void set_accuracy(double good_guess, double accepted, double tolerance) {
    solver.accuracy = {good_guess, accepted, tolerance, solver.accuracy.budget};
  }
  void set_default_accuracy() { set_accuracy(default_[0], default_[1], default_[2]); }
  // Of fixed steps: largest residual of a solution [m/s, rad/s]; floating-point operations per
  // island and simulated second [1/s], 0: those of ImpulseSolver.
  void set_effort(double accuracy, double budget) {
    default_ = {accuracy, accuracy, accuracy / 50};
    set_default_accuracy();
    budget_ = budget;
  }

 private:
  std::vector<std::size_t> first_;  // by source: index of its first constraint
  double budget_ = 0;
  std::array<double, 3> default_{solver.accuracy.good_guess, solver.accuracy.accepted,
                                 solver.accuracy.tolerance};
};

}  // namespace twinarm
