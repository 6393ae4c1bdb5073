// What the phases of a step under constraints share (constrained_step.h): who gives constraints,
// the problem that they make, and its solver.
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
  std::vector<double> velocity;  // v0 of the problem, as keep_velocities() found it

  void begin_step(const IntegrationState& m, double h);
  // m.w.qdd at m.x, whose m.k is up to date, without constraints.
  void accelerate(IntegrationState& m, double h);
  // A problem without constraints; with the implicit terms of `forces` where given.
  void begin_problem(const Forces<double>* forces, Workspace<double>& w);
  // v0 of the problem, before anything is added to it.
  void keep_velocities(ConstraintFrame& frame);
  void add_sources(const ConstraintFrame& frame);
  void distribute_impulses(const ConstraintFrame& frame);  // the solution, to the sources

  // Residuals [m/s]: of a guess and of a solution that will do, and what a solution aims at.
  void set_accuracy(double good_guess, double accepted, double aim) {
    solver.good_guess = good_guess, solver.accepted = accepted, solver.tolerance = aim;
  }
  void set_usual_accuracy() { set_accuracy(usual_[0], usual_[1], usual_[2]); }

 private:
  std::vector<std::size_t> first_;  // by source: its first constraint in the problem
  std::array<double, 3> usual_{solver.good_guess, solver.accepted, solver.tolerance};
};

}  // namespace twinarm
