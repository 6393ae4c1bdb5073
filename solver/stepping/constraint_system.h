// Shared by the phases of a constrained step (constrained_step.h): constraint sources, impulse
// problem and its solver.
#pragma once

#include <array>
#include <vector>

#include "solver/impulses/constraint_source.h"
#include "solver/impulses/impulse_solver.h"
#include "solver/impulses/kinematic_trees.h"
#include "solver/integration/integration_state.h"
#include "solver/stepping/bilateral_constraints.h"
#include "solver/stepping/friction_constraints.h"

namespace twinarm {

class ConstraintSystem {
 public:
  explicit ConstraintSystem(const Model<double>& model)
      : trees(model), bilateral(model), friction(model) {}

  KinematicTrees trees;
  std::vector<ConstraintSource*> sources;
  BilateralConstraints bilateral;
  FrictionConstraints friction;
  ImpulseProblem problem;
  ImpulseSolver solver;
  std::vector<double> velocity;  // v0 at store_velocities()

  void begin_step(const IntegrationState& m, double h) {
    for (ConstraintSource* source : sources) source->begin_step(m.k, m.x, h);
  }
  // m.w.qdd at m.x without constraints; m.k must be up to date.
  void accelerate(IntegrationState& m, double h);
  // Starts a problem without constraints, with the implicit terms of `forces` if given.
  void begin_problem(const Forces<double>* forces, Workspace<double>& w) {
    problem.clear();
    trees.add_to(problem, forces, w);
  }
  void store_velocities(ConstraintFrame& frame);  // copies v0 of the problem
  void add_sources(const ConstraintFrame& frame);
  // Passes the solution to the sources.
  void distribute_impulses(const ConstraintFrame& frame) {
    for (std::size_t s = 0; s < sources.size(); ++s)
      sources[s]->read_impulses(frame, problem, first_[s]);
  }

  // Residuals [m/s]: of an accepted guess, of an accepted solution, target of the iteration.
  void set_accuracy(double good_guess, double accepted, double tolerance) {
    solver.good_guess = good_guess, solver.accepted = accepted, solver.tolerance = tolerance;
  }
  void set_default_accuracy() { set_accuracy(default_[0], default_[1], default_[2]); }

 private:
  std::vector<std::size_t> first_;  // by source: index of its first constraint
  std::array<double, 3> default_{solver.good_guess, solver.accepted, solver.tolerance};
};

}  // namespace twinarm
