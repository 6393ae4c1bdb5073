#include "solver/loops/loop_forces.h"

#include <algorithm>
#include <utility>

#include "solver/dynamics/dynamics.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {

ConstraintForceSolver::ConstraintForceSolver(const Model<double>& model)
    : model_(&model),
      rows_(model.mimics.size()),
      factors_(rows_),
      Z_(rows_ * model.nv),
      lambda_(rows_),
      no_forces_(model.nv),
      of_rows_(model) {}

void ConstraintForceSolver::set_loops(LoopClosures loops) {
  loops_ = std::move(loops);
  rows_ = model_->mimics.size() + loops_.rows();
  const std::size_t max_rows = rows_ + (loops_.any() ? model_->nv : 0);
  factors_ = PivotedCholesky(max_rows);
  Z_.assign(max_rows * model_->nv, 0);
  lambda_.assign(max_rows, 0);
  held_.clear();
  held_.reserve(max_rows);
}

// Calls f(dof, value) for the entries of a row of A.
template <class F>
void ConstraintForceSolver::for_each_entry(std::size_t row, F&& f) const {
  if (row < model_->mimics.size()) {
    const Mimic& m = model_->mimics[row];
    f(m.follower, 1.0);
    f(m.leader, -m.ratio);
  } else if (row < rows_) {
    const std::size_t r = row - model_->mimics.size();
    for (const std::size_t d : loops_.dofs_of(r))
      f(d, loops_.J()(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(d)));
  } else {
    f(held_[row - rows_], 1.0);
  }
}

double ConstraintForceSolver::row_times(std::size_t row, const double* v) const {
  double sum = 0;
  for_each_entry(row, [&](std::size_t d, double entry) { sum += entry * v[d]; });
  return sum;
}

void ConstraintForceSolver::prepare(const Workspace<double>& w,
                                    const std::vector<std::size_t>& held,
                                    double tolerance) noexcept {
  constexpr std::size_t kLanes = 4;
  held_.assign(held.begin(), held.end());
  const std::size_t n = rows_ + held_.size();
  for (std::size_t first = 0; first < n; first += kLanes) {
    const std::size_t end = std::min(first + kLanes, n);
    for (std::size_t j = first; j < end; ++j)
      for_each_entry(j, [&](std::size_t d, double entry) {
        set_lane(of_rows_.b[d], j - first, of_rows_.b[d][static_cast<int>(j - first)] + entry);
      });
    minv_times(*model_, w, of_rows_);
    for (std::size_t j = first; j < end; ++j) {
      double* const Z = &Z_[j * model_->nv];
      for (std::size_t d = 0; d < model_->nv; ++d) Z[d] = lane_of(of_rows_.y[d], j - first);
      for_each_entry(j, [&](std::size_t d, double) { of_rows_.b[d] = 0; });
      for (std::size_t i = 0; i <= j; ++i) factors_(i, j) = factors_(j, i) = row_times(i, Z);
    }
  }
  factors_.factorise(n, tolerance);
}

void ConstraintForceSolver::solve(const std::vector<double>& a,
                                  const std::vector<double>& b) noexcept {
  const std::size_t mimics = model_->mimics.size();
  for (std::size_t j = 0; j < rows_ + held_.size(); ++j) {
    const double* Z = &Z_[j * model_->nv];
    lambda_[j] = -row_times(j, a.data());
    if (j >= mimics && j < rows_)
      lambda_[j] -= loops_.gamma()[static_cast<Eigen::Index>(j - mimics)];
    for (std::size_t d = 0; d < model_->nv; ++d) lambda_[j] -= Z[d] * b[d];
  }
  factors_.solve(lambda_.data());
}

void ConstraintForceSolver::add_accelerations(std::vector<double>& y) const noexcept {
  for (std::size_t j = 0; j < rows_ + held_.size(); ++j) {
    if (lambda_[j] == 0) continue;
    const double* Z = &Z_[j * model_->nv];
    for (std::size_t d = 0; d < model_->nv; ++d) y[d] += Z[d] * lambda_[j];
  }
}

void ConstraintForceSolver::add_forces(std::vector<double>& mimic,
                                       std::vector<double>& loop) const {
  for (std::size_t j = 0; j < rows_; ++j) {
    std::vector<double>& tau = j < model_->mimics.size() ? mimic : loop;
    for_each_entry(j, [&](std::size_t d, double entry) { tau[d] += entry * lambda_[j]; });
  }
}

void ConstraintForceSolver::project(std::vector<double>& y) noexcept {
  for (std::size_t j = 0; j < rows_ + held_.size(); ++j) lambda_[j] = -row_times(j, y.data());
  factors_.solve(lambda_.data());
  add_accelerations(y);
}

void ConstraintForceSolver::correction(const Eigen::VectorXd& residual,
                                       std::vector<double>& out) noexcept {
  const std::size_t mimics = model_->mimics.size();
  for (std::size_t j = 0; j < rows_ + held_.size(); ++j)
    lambda_[j] = j >= mimics && j < rows_ ? -residual[static_cast<Eigen::Index>(j - mimics)] : 0;
  factors_.solve(lambda_.data());
  std::fill(out.begin(), out.end(), 0);
  add_accelerations(out);
}

void ConstraintForceSolver::correction_of_loop(std::size_t loop, const std::vector<double>& lambda,
                                               std::vector<double>& out) const {
  std::fill(out.begin(), out.end(), 0);
  for (std::size_t r = loops_.first_row(loop); r < loops_.rows() && loops_.loop_of(r) == loop;
       ++r) {
    const double* Z = &Z_[(model_->mimics.size() + r) * model_->nv];
    for (std::size_t d = 0; d < model_->nv; ++d) out[d] += Z[d] * lambda[r];
  }
}

void ConstraintForceSolver::copy_factors(const ConstraintForceSolver& from) noexcept {
  Z_ = from.Z_;
  factors_ = from.factors_;
  held_ = from.held_;
}

Eigen::VectorXd ConstraintForceSolver::lambda_of_loops() const {
  Eigen::VectorXd lambda(static_cast<Eigen::Index>(loops_.rows()));
  for (Eigen::Index r = 0; r < lambda.size(); ++r)
    lambda[r] = lambda_[model_->mimics.size() + static_cast<std::size_t>(r)];
  return min_solution(loops_.J().transpose(), loops_.J().transpose() * lambda, 1e-9);
}

}  // namespace twinarm
