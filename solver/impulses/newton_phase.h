// Newton's method on one island: first and last phase of island_solver.h.
//
// Augmented Lagrangian (method of multipliers, Rockafellar 1976): with frozen multipliers and de
// Saxce shifts, the inner problem
//   M (v - v0) = J^T p(u(v))
// is the optimality condition of min 1/2 |v - v0|_M^2 + sum_i phi_i(u_i), phi_i' = -p, smooth and
// strictly convex: semismooth Newton with an exact line search on the matrices
//   M + J^T D J,    D = -dp/du,
// whose block pattern follows the contacts between trees (as in Castro, Permenter and Han 2022,
// with compliance instead of multipliers). Each inner problem ends with Newton steps that
// differentiate the shift, while they converge.
#pragma once

#include "solver/impulses/newton_matrix.h"

namespace twinarm {

class NewtonPhase {
 public:
  NewtonPhase(ImpulseIsland& island, NewtonMatrix& matrix) : island_(island), matrix_(matrix) {}

  static constexpr double kFirstRho = 1e2;  // penalty, relative to rho0
  static constexpr int kFewSteps = 28;      // up to these, without step halving

  // Augmented-Lagrangian iterations with at most max_steps Newton steps, from p and u of the
  // constraints and v; the best p is kept in the island, the last p is set.
  void solve(int max_steps, double rho, ImpulseReport& report);
  // Newton steps with a multiplier update each, from a guess close to the solution. Returns the
  // residual of the laws; infinity if no step was taken.
  double solve_near(ImpulseReport& report);
  // Refines a solution to rounding while the residual decreases. Returns the residual.
  double refine(double residual);

 private:
  struct Gradient : ImpulseIsland::Imbalance {
    double tolerance = 0;  // ends the Newton iteration
    double noise = 0;      // rounding error
    double error() const { return largest <= noise ? 0 : largest; }
  };
  struct InnerResult {
    int steps = 0;
    double error = 0;  // of M (v - v0) = J^T p, as a velocity [m/s]
  };
  InnerResult solve_inner_problem(int max_steps);
  double rounding_error();
  Gradient gradient(DeSaxceShift shift);
  void project_disc(const ImpulseConstraint& c, int i);
  void find_direction(bool symmetric);
  double step_length();
  double semismooth_step(double residual);

  ImpulseIsland& island_;
  NewtonMatrix& matrix_;
  std::vector<Vec> iterate_p_;    // by constraint
  std::vector<double> convex_v_;  // by velocity
  double rho_ratio_ = 0;          // rho / rho0
  double rounding_error_ = 0;     // for rho = rho0 [m/s]
};

}  // namespace twinarm
