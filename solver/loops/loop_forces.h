// The forces of all bilateral constraints at once: joints that follow others (mimic.h), and loop
// closures (loop_closure.h).
//
// With A the rows of both (RBDA sections 8.2, 8.3):
//   M qdd = tau - h + A^T lambda,   A qdd = -gamma   (gamma = 0 of mimics),
// so that with a = M^-1 (tau - h)
//   G lambda = -(A a + gamma),   G = A M^-1 A^T.
// M^-1 A^T comes in O(n) a row from the factors that ABA left (minv_times). G is singular where
// constraints are redundant: pivoted_cholesky.h. Any lambda that solves it gives the same qdd, for
// what is free in lambda does not reach A^T lambda. A^T lambda does no work on velocities with A qd
// = 0.
#pragma once

#include <vector>

#include "solver/linear_algebra/pivoted_cholesky.h"
#include "solver/loops/loop_closure.h"
#include "solver/model/model.h"
#include "solver/model/workspace.h"

namespace twinarm {

class ConstraintForceSolver {
 public:
  explicit ConstraintForceSolver(const Model<double>& model);
  void set_loops(LoopClosures loops);
  bool any() const { return rows_ > 0; }
  const LoopClosures& loops() const { return loops_; }
  LoopClosures& loops() { return loops_; }

  // After aba() at the same coordinates, or near by, with loops().evaluate() where A is wanted.
  // Uses w.y, w.p, w.dv. `held` are velocities that are to stay as they are: rows of their own.
  void prepare(Workspace<double>& w, const std::vector<std::size_t>& held = {},
               double tolerance = PivotedCholesky::kDependent) noexcept;
  const std::vector<std::size_t>& held() const { return held_; }
  // What prepare() found there, as if it had been found here.
  void take_factors(const ConstraintForceSolver& from) noexcept;

  // Sets lambda so that A (a + M^-1 b + M^-1 A^T lambda) = -gamma.
  void solve(const std::vector<double>& a, const std::vector<double>& b) noexcept;
  // A^T lambda, the parts of either.
  void add_forces(std::vector<double>& mimic, std::vector<double>& loop) const;
  // An acceleration a, or y = M^-1 b of some b alone, to what it is with the constraints.
  void project_acceleration(std::vector<double>& a) noexcept;
  void project(std::vector<double>& y) noexcept;
  // M^-1 A^T lambda such that the loops' rows of A times it are -residual, all others' 0.
  void correction(const Eigen::VectorXd& residual, std::vector<double>& out) noexcept;

  // Adds `part` of lambda of the last solve() or correction(), of the loops' rows.
  void add_lambda(double part, std::vector<double>& sum) const;
  // M^-1 A^T lambda, of one loop's rows and as prepare() found them; lambda as add_lambda() has it.
  void shift_of(std::size_t loop, const std::vector<double>& lambda,
                std::vector<double>& out) const;

  std::size_t rank() const { return factors_.rank(); }  // of all rows of the last prepare()
  // Of the loops' rows, of the last solve(); where rows are redundant the shortest of all with the
  // same J^T lambda. Allocates.
  Eigen::VectorXd lambda_of_loops() const;

 private:
  template <class F>
  void for_each_entry(std::size_t row, F&& f) const;
  double row_times(std::size_t row, const double* v) const;
  void add_accelerations(std::vector<double>& y) const noexcept;  // M^-1 A^T lambda

  const Model<double>* model_;
  LoopClosures loops_;
  std::size_t rows_ = 0;  // of mimics and loops; those of held_ come after them
  std::vector<std::size_t> held_;
  PivotedCholesky factors_;
  std::vector<double> Z_;  // M^-1 A^T, one row of A after the other
  std::vector<double> lambda_, b_;
  std::vector<Force<double>> no_forces_;
};

}  // namespace twinarm
