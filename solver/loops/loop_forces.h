// Constraint forces (Lagrange multipliers) of all bilateral constraints:
// mimic joints (mimic.h) and loop closures (loop_closure.h).
//
// With A the rows of both (RBDA sections 8.2, 8.3) and C the joint-space bias force:
//   M qdd = tau - C + A^T lambda,   A qdd = -gamma   (gamma = 0 for mimic joints),
// and with a = M^-1 (tau - C)
//   G lambda = -(A a + gamma),   G = A M^-1 A^T.
// M^-1 A^T costs O(n) per row with the factors of ABA (minv_times). Redundant constraints make G
// singular (pivoted_cholesky.h); every solution lambda has the same A^T lambda and qdd.
#pragma once

#include <vector>

#include "solver/linear_algebra/pivoted_cholesky.h"
#include "solver/loops/loop_closure.h"
#include "solver/model/model.h"
#include "solver/model/workspace.h"
#include "solver/spatial/batch.h"

namespace twinarm {

class ConstraintForceSolver {
 public:
  explicit ConstraintForceSolver(const Model<double>& model);
  void set_loops(LoopClosures loops);
  bool any() const { return rows_ > 0; }
  const LoopClosures& loops() const { return loops_; }
  LoopClosures& loops() { return loops_; }

  // Factorises G; requires aba() at the same or a nearby q, and loops().evaluate() for A.
  // `held`: velocities with zero acceleration, as additional rows.
  void prepare(const Workspace<double>& w, const std::vector<std::size_t>& held = {},
               double tolerance = PivotedCholesky::kDependent) noexcept;
  const std::vector<std::size_t>& held() const { return held_; }
  // Copies the result of prepare() of another solver.
  void copy_factors(const ConstraintForceSolver& from) noexcept;

  // Solves A (a + M^-1 b + M^-1 A^T lambda) = -gamma for lambda.
  void solve(const std::vector<double>& a, const std::vector<double>& b) noexcept;
  // Adds A^T lambda, separately for mimic joints and loops.
  void add_forces(std::vector<double>& mimic, std::vector<double>& loop) const;
  // Adds the acceleration of the constraint forces to an acceleration a, or to y = M^-1 b.
  void project_acceleration(std::vector<double>& a) noexcept {
    solve(a, no_forces_);
    add_accelerations(a);
  }
  void project(std::vector<double>& y) noexcept;
  // out = M^-1 A^T lambda with J out = -residual for the loops' rows, 0 for the other rows.
  void correction(const Eigen::VectorXd& residual, std::vector<double>& out) noexcept;

  // sum += s lambda for the loops' rows of the last solve() or correction().
  void add_lambda(double s, std::vector<double>& sum) const {
    for (std::size_t r = 0; r < loops_.rows(); ++r)
      sum[r] += s * lambda_[model_->mimics.size() + r];
  }
  // out = M^-1 A^T lambda of one loop's rows, with A of prepare(); lambda as in add_lambda().
  void correction_of_loop(std::size_t loop, const std::vector<double>& lambda,
                          std::vector<double>& out) const;

  std::size_t rank() const { return factors_.rank(); }  // of all rows of the last prepare()
  // lambda of the loops' rows of the last solve(); for redundant rows that of minimum norm with the
  // same J^T lambda. Allocates.
  Eigen::VectorXd lambda_of_loops() const;

 private:
  template <class F>
  void for_each_entry(std::size_t row, F&& f) const;
  double row_times(std::size_t row, const double* v) const;
  void add_accelerations(std::vector<double>& y) const noexcept;  // M^-1 A^T lambda

  const Model<double>* model_;
  LoopClosures loops_;
  std::size_t rows_ = 0;  // of mimics and loops, followed by those of held_
  std::vector<std::size_t> held_;
  PivotedCholesky factors_;
  std::vector<double> Z_;  // M^-1 A^T, by row of A
  std::vector<double> lambda_;
  std::vector<double> no_forces_;     // by velocity
  RightHandSides<Batch<4>> of_rows_;  // b zero between calls of prepare()
};

}  // namespace twinarm
