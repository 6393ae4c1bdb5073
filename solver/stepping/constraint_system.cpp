#include "solver/stepping/constraint_system.h"

#include "solver/dynamics/dynamics.h"

namespace twinarm {

void ConstraintSystem::accelerate(IntegrationState& m, double h) {
  m.forces.clear();
  for (ForceSource* source : m.sources) source->add_forces(m.x, m.k, m.forces);
  friction.add_dampers(m.x, h, m.forces);
  aba(m.model, m.x, m.forces, m.w);
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
