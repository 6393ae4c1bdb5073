// First phase of island_solver.h: block Gauss-Seidel sweeps, each constraint
// solved exactly with the others held, accelerated as a nonlinear conjugate-gradient method
// (Silcowitz-Hansen, Niebe and Erleben 2010). Contacts of free bodies come first, several in a SIMD
// batch. A sweep costs a hundredth of a Newton step. Sweeps identify sticking and sliding in tens
// to hundreds of sweeps; towers of redundant contacts, whose errors decay slowly, are left to the
// phases that follow.
#pragma once

#include "solver/impulses/cone_batch.h"
#include "solver/impulses/impulse_island.h"

namespace twinarm {

class ConjugateSweeps {
 public:
  // Constants of the island for sweep(); from p of the constraints and v of the trees, which must
  // satisfy the momentum balance.
  void start(ImpulseIsland& island);
  // One sweep. Returns the maximum change of an impulse, as a velocity [m/s, rad/s].
  double sweep();
  void write_impulses();  // p of the constraints

 private:
  void set_local(const ImpulseConstraint& c, int i);
  bool fits(const ImpulseConstraint& c, const ConeBatch& batch) const;
  void add_to_batch(const ImpulseConstraint& c, int i);
  Vec solve_constraint(const ImpulseConstraint& c, int i);

  ImpulseIsland* island_ = nullptr;
  ImpulseProblem* problem_ = nullptr;
  std::vector<ConeBatch> batches_;
  std::vector<int> others_;  // constraints that are in no batch
  // By constraint; change_ and direction_ of the others.
  std::vector<LocalProblem<double>> local_;
  std::vector<Vec> change_, direction_;
  std::vector<double> Y_;  // M^-1 J^T, laid out as J
  // By velocity: now, with six zeros at the end in place of the world's; before the sweep; of
  // direction_.
  std::vector<double> v_, last_v_, v_direction_;
  double squared_ = 0, last_squared_ = 0;  // changes of the last two sweeps
};

}  // namespace twinarm
