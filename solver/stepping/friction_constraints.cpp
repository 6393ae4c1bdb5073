#include "solver/stepping/friction_constraints.h"

namespace twinarm {

void FrictionConstraints::add_dampers(const State<double>& x, double h,
                                      Forces<double>& forces) const {
  for (std::size_t dof = 0; is_on_ && dof < model_->nv; ++dof) {
    if (model_->damping[dof] == 0) continue;
    forces.tau[dof] -= model_->damping[dof] * x.qd[dof];
    forces.armature[dof] += h * model_->damping[dof];
  }
}

void FrictionConstraints::add_to(ImpulseProblem& problem, const KinematicTrees& trees, double h) {
  first_ = problem.constraints().size();
  for (std::size_t dof = 0; is_on_ && dof < model_->nv; ++dof) {
    if (!has_coulomb(dof)) continue;
    ImpulseConstraint& c =
        problem.add(ConstraintType::box, 1, trees.tree_of_dof(dof), ImpulseConstraint::no_tree);
    problem.J(c, 0)[trees.index_in_tree(dof)] = 1;
    c.low = -h * model_->coulomb_plus[dof], c.high = h * model_->coulomb_minus[dof];
    c.p[0] = std::clamp(guess_[dof], c.low, c.high);
  }
}

void FrictionConstraints::read_impulses(const ImpulseProblem& problem, double h) {
  std::size_t next = first_;
  for (std::size_t dof = 0; is_on_ && dof < model_->nv; ++dof)
    if (has_coulomb(dof)) {
      guess_[dof] = problem.constraints()[next++].p[0];
      torque_[dof] = guess_[dof] / h;
    }
}

}  // namespace twinarm
