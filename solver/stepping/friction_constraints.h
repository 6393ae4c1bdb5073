// Joint damping and Coulomb friction in a constrained step (constrained_step.h). Damping acts at
// the end of the step (armature h b). Coulomb friction is a box-constrained impulse per dof.
#pragma once

#include <algorithm>
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

}  // namespace twinarm
