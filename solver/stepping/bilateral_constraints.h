// Mimic joints and loops as bilateral constraints g' = 0 of a step (constrained_step.h).
#pragma once

#include <vector>

#include "solver/constraints/constraint_source.h"
#include "solver/integration/integration_state.h"
#include "solver/support/state_archive.h"

namespace twinarm {

class BilateralConstraints {
 public:
  explicit BilateralConstraints(const Model<double>& model)
      : model_(&model), mimic_guess_(model.mimics.size()) {}
  // Loops: J qdd + gamma = 0 (forces at this instant) instead of g' = 0 after the step. Runs use
  // g' = 0 without gamma, which cannot increase the energy.
  void constrain_accelerations() { with_gamma_ = true; }

  void add_to(ImpulseProblem& problem, const KinematicTrees& trees, IntegrationState& m,
              Phase phase, double h = 0);
  // Stores the solution's impulses as initial guess of the next step.
  void keep_guesses(const ImpulseProblem& problem);
  // Adds work and impulses of the constraints (constraint_work.h); `before`: v0 of the problem.
  void add_work(const ImpulseProblem& problem, const double* before, IntegrationState& m,
                Phase phase);

  void clear_loop_guesses() { loop_guess_.clear(); }
  void serialize(StateArchive& archive, std::size_t loop_rows);

 private:
  void add_mimics(ImpulseProblem& problem, const KinematicTrees& trees);
  void add_loops(ImpulseProblem& problem, const KinematicTrees& trees, IntegrationState& m,
                 Phase phase, double h);

  const Model<double>* model_;
  bool with_gamma_ = false;
  std::size_t first_ = 0;                         // index of the first constraint in the problem
  std::vector<double> mimic_guess_, loop_guess_;  // loops: empty before the first step
  Eigen::VectorXd lambda_;                        // impulses of the loops' rows
};

}  // namespace twinarm
