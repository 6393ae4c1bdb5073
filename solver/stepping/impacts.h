// The impacts of a step under constraints (constrained_step.h).
//
// Newton's law may ask for what cannot be: a body that is wedged between two surfaces, by friction
// beyond the angle between them, cannot leave one of them without being pressed into the other.
// Then no velocities obey the law, however small the restitution, and impulses grow without bound
// where they are sought. What touches such a body is taken without restitution: that has a
// solution, since not to move obeys u >= 0, and it gains no energy.
#pragma once

#include <vector>

#include "solver/stepping/constraint_system.h"

namespace twinarm {

struct ConstraintReport {
  int impacts = 0;             // passes of the first phase
  int infeasible_impacts = 0;  // of these: what no velocities obey, restitution left out
  ImpulseReport step, impact;  // impact: the worst of its passes
  double impact_loss = 0;      // kinetic energy that impacts took [J]
};

class Impacts {
 public:
  // While something closes: new velocities of m.x. Returns the number of passes.
  int resolve(ConstraintSystem& system, IntegrationState& m, double h, Phase phase,
              ConstraintReport& report);

 private:
  static constexpr int max_impacts = 50;
  ImpulseReport solve(ConstraintSystem& system, IntegrationState& m, ConstraintFrame& frame);
  double bounce(ImpulseProblem& problem);

  std::vector<char> plastic_;                   // by tree
  std::vector<double> acceleration_, by_tree_;  // without constraints, at the start
  std::vector<double> elastic_, elastic_p_;     // velocities and impulses
};

}  // namespace twinarm
