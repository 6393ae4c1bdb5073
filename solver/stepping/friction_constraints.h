// Damping and Coulomb friction of joints in a step under constraints (constrained_step.h). Dampers
// act at the end of the step: h b is armature. Coulomb friction is a bounded impulse of each dof.
#pragma once

#include <vector>

#include "solver/impulses/kinematic_trees.h"
#include "solver/support/state_archive.h"

namespace twinarm {

class FrictionConstraints {
 public:
  explicit FrictionConstraints(const Model<double>& model)
      : model_(&model), torque_(model.nv), guess_(model.nv) {}
  void set_on(bool on) { is_on_ = on; }

  void add_dampers(const State<double>& x, double h, Forces<double>& forces) const;
  void add_to(ImpulseProblem& problem, const KinematicTrees& trees, double h);
  // After the solution, over a step of h: its impulses are torques, and the next guesses.
  void take(const ImpulseProblem& problem, double h);
  void clear();                                                  // no torque
  const std::vector<double>& torque() const { return torque_; }  // by velocity [N m, N]
  void serialize(StateArchive& memory) { memory.visit_fixed(guess_); }

 private:
  bool has_coulomb(std::size_t dof) const {
    return model_->coulomb_plus[dof] > 0 || model_->coulomb_minus[dof] > 0;
  }
  const Model<double>* model_;
  bool is_on_ = true;
  std::size_t first_ = 0;  // of the constraints in the problem
  std::vector<double> torque_, guess_;
};

}  // namespace twinarm
