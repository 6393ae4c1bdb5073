#include "solver/stepping/constraint_system.h"

#include "solver/dynamics/dynamics.h"

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

void ConstraintSystem::accelerate(IntegrationState& m, double h) {
  m.forces.clear();
  for (ForceSource* source : m.sources) source->add_forces(m.x, m.k, m.forces);
  friction.add_dampers(m.x, h, m.forces);
  aba(m.model(), m.x, m.forces, m.w);
  if (!m.has_loops()) return;
  m.dynamics.bilateral().loops().evaluate(m.x, m.k);
  m.dynamics.bilateral().prepare(m.w);
  m.start_projection();
}

void ConstraintSystem::store_velocities(ConstraintFrame& frame) {
  if (problem.nv() == 0) return;
  velocity.assign(problem.v0(0), problem.v0(0) + problem.nv());
  frame.v = velocity.data();
}

void ConstraintSystem::add_sources(const ConstraintFrame& frame) {
  first_.clear();
  for (ConstraintSource* source : sources) {
    first_.push_back(problem.constraints().size());
    source->add_constraints(frame, problem);
  }
}

}  // namespace twinarm
