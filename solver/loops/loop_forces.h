// Constraint forces (Lagrange multipliers) of all bilateral constraints:
// mimic joints (mimic.h) and loop closures (loop_closure.h).
//
// With A the rows of both (RBDA sections 8.2, 8.3) and C the joint-space bias force:
//   M qdd = tau - C + A^T lambda,   A qdd = -gamma   (gamma = 0 for mimic joints),
// and with a = M^-1 (tau - C), y = qdd - a
//   M y = A^T lambda,   A y = -(A a + gamma).
// Each lambda is eliminated within the articulated-body recursion, O(n + m) for m rows
// (constraint_elimination.h). Redundant constraints: every solution lambda has the same A^T lambda
// and qdd.
#pragma once

#include <vector>

#include "solver/loops/constraint_elimination.h"
#include "solver/loops/loop_closure.h"
#include "solver/model/model.h"
#include "solver/model/workspace.h"

namespace twinarm {

class ConstraintForceSolver {
 public:
  explicit ConstraintForceSolver(const Model<double>& model);
  void set_loops(LoopClosures loops);
  bool any() const { return !rows_.empty(); }
  const LoopClosures& loops() const { return loops_; }
  LoopClosures& loops() { return loops_; }

  // Requires aba() at the same or a nearby q, and loops().evaluate() for A. `held`: velocities with
  // y = 0.
  void prepare(const Workspace<double>& w, const std::vector<std::size_t>& held = {},
               double tolerance = PivotedCholesky::kDependent) noexcept;
  const std::vector<std::size_t>& held() const { return elimination_.held(); }
  // Copies the result of prepare() of another solver.
  void copy_factors(const ConstraintForceSolver& from) noexcept {
    elimination_.copy_factors(from.elimination_);
  }

  // Solves M y = b + A^T lambda, A (a + y) = -gamma.
  void solve(const std::vector<double>& a, const std::vector<double>& b) noexcept;
  const std::vector<double>& y() const { return elimination_.y(); }
  // Spatial accelerations of the bodies for qdd = y.
  const std::vector<Motion<double>>& dv() const { return elimination_.dv(); }
  // Adds A^T lambda, separately for mimic joints and loops.
  void add_forces(std::vector<double>& mimic, std::vector<double>& loop) const;
  // Adds the acceleration of the constraint forces to an acceleration a, or to y = M^-1 b.
  void project_acceleration(std::vector<double>& a) noexcept;
  void project(std::vector<double>& y) noexcept;
  // out = M^-1 A^T lambda with J out = -residual for the loops' rows, 0 for the other rows.
  void correction(const Eigen::VectorXd& residual, std::vector<double>& out) noexcept;

  // sum += s lambda for the loops' rows of the last solve() or correction().
  void add_lambda(double s, std::vector<double>& sum) const {
    for (std::size_t r = 0; r < loops_.rows(); ++r)
      sum[r] += s * elimination_.lambda(rows_[model_->mimics.size() + r]);
  }
  // out = M^-1 A^T lambda of one loop's rows, with A of prepare(); lambda as in add_lambda().
  void correction_of_loop(std::size_t loop, const std::vector<double>& lambda,
                          std::vector<double>& out) noexcept;

  std::size_t rank() const { return elimination_.rank(); }  // of all rows of the last prepare()
  // lambda of the loops' rows of the last solve(); for redundant rows that of minimum norm with the
  // same J^T lambda. Allocates.
  Eigen::VectorXd lambda_of_loops() const;

 private:
  ConstraintElimination elimination_of_rows();
  template <class F>
  void for_each_entry(std::size_t row, F&& f) const;
  double row_times(std::size_t row, const std::vector<double>& v) const;

  const Model<double>* model_;
  LoopClosures loops_;
  std::vector<std::size_t> rows_;  // of mimics and loops: their number in elimination_
  ConstraintElimination elimination_;
  std::vector<double> no_forces_, forces_;  // by velocity
};

}  // namespace twinarm
