// Impacts of a constrained step (constrained_step.h).
//
// Newton's law of restitution can be infeasible: a body wedged between two surfaces, with friction
// angles larger than the wedge allows, cannot separate from one without being pressed into the
// other, and the impulses of an iteration diverge. All contacts of such a tree are then inelastic:
// this problem is feasible (v = 0 satisfies u >= 0) and does not increase the energy.
#pragma once

#include <vector>

#include "solver/stepping/constraint_system.h"

namespace twinarm {

struct ConstraintReport {
  int impacts = 0;             // passes of the impact phase
  int infeasible_impacts = 0;  // passes with infeasible restitution, made inelastic
  ImpulseReport step, impact;  // impact: pass with the largest residual
  double impact_loss = 0;      // kinetic energy dissipated by impacts [J]
};

class Impacts {
 public:
  // Updates the velocities of m.x while contacts close. Returns the number of passes.
  int resolve(ConstraintSystem& system, IntegrationState& m, double h, Phase phase,
              ConstraintReport& report);

 private:
  static constexpr int kMaxImpacts = 50;
  ImpulseReport solve(ConstraintSystem& system, IntegrationState& m, ConstraintFrame& frame);
  double blend_towards_elastic(ImpulseProblem& problem);

  std::vector<char> plastic_;                   // by tree: inelastic
  std::vector<double> acceleration_, by_tree_;  // without constraints, at the start of the step
  std::vector<double> elastic_, elastic_p_;     // velocities and impulses
};

}  // namespace twinarm
