// Mimics and closed loops as constraints of a step (constrained_step.h): g' = 0 of each.
#pragma once

#include <vector>

#include "solver/impulses/constraint_source.h"
#include "solver/integration/integration_state.h"
#include "solver/support/state_archive.h"

namespace twinarm {

class BilateralConstraints {
 public:
  explicit BilateralConstraints(const Model<double>& model)
      : model_(&model), mimic_guess_(model.mimics.size()) {}
  // Loops: J qdd + gamma = 0, the forces of this instant, in place of g' = 0 after the step. A run
  // leaves gamma to the impulses that put velocities right: they cannot give energy.
  void constrain_accelerations() { with_gamma_ = true; }

  void add_to(ImpulseProblem& problem, const KinematicTrees& trees, IntegrationState& m,
              Phase phase, double h = 0);
  // After the solution: its impulses are the next guesses.
  void keep_guesses(const ImpulseProblem& problem);
  // Works and momenta of what add_to() added (constraint_work.h); `before`: v0 of the problem.
  void count(const ImpulseProblem& problem, const double* before, IntegrationState& m, Phase phase);

  // Guesses of impulses. Those of loops: none before the first step, then one for each row.
  void forget_loops() { loop_guess_.clear(); }
  void serialize(StateArchive& memory, std::size_t loop_rows);

 private:
  void add_mimics(ImpulseProblem& problem, const KinematicTrees& trees);
  void add_loops(ImpulseProblem& problem, const KinematicTrees& trees, IntegrationState& m,
                 Phase phase, double h);

  const Model<double>* model_;
  bool with_gamma_ = false;
  std::size_t first_ = 0;  // of the constraints in the problem
  std::vector<double> mimic_guess_, loop_guess_;
  Eigen::VectorXd lambda_;  // impulses of the loops' rows
};

}  // namespace twinarm
