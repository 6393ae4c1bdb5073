#include "solver/loops/loop_forces.h"

#include <algorithm>
#include <utility>

#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {
namespace {

void add(const std::vector<double>& y, std::vector<double>& sum) {
  for (std::size_t d = 0; d < sum.size(); ++d) sum[d] += y[d];
}

}  // namespace

ConstraintForceSolver::ConstraintForceSolver(const Model<double>& model)
    : model_(&model),
      elimination_(elimination_of_rows()),
      no_forces_(model.nv),
      forces_(model.nv) {}

void ConstraintForceSolver::set_loops(LoopClosures loops) {
  loops_ = std::move(loops);
  elimination_ = elimination_of_rows();
}

// Each mimic joint has a batch, each loop one or two.
ConstraintElimination ConstraintForceSolver::elimination_of_rows() {
  std::vector<std::vector<std::size_t>> dofs;
  rows_.clear();
  for (const Mimic& m : model_->mimics) {
    rows_.push_back(4 * dofs.size());
    dofs.push_back({m.follower, m.leader});
  }
  for (std::size_t r = 0; r < loops_.rows(); ++r) {
    const std::size_t lane = (r - loops_.first_row(loops_.loop_of(r))) % 4;
    if (lane == 0) dofs.push_back(loops_.dofs_of(r));
    rows_.push_back(4 * (dofs.size() - 1) + lane);
  }
  return {*model_, dofs};
}

// Calls f(dof, value) for the entries of a row of A.
template <class F>
void ConstraintForceSolver::for_each_entry(std::size_t row, F&& f) const {
  if (row < model_->mimics.size()) {
    const Mimic& m = model_->mimics[row];
    f(m.follower, 1.0);
    f(m.leader, -m.ratio);
  } else {
    const std::size_t r = row - model_->mimics.size();
    for (const std::size_t d : loops_.dofs_of(r))
      f(d, loops_.J()(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(d)));
  }
}

double ConstraintForceSolver::row_times(std::size_t row, const std::vector<double>& v) const {
  double sum = 0;
  for_each_entry(row, [&](std::size_t d, double entry) { sum += entry * v[d]; });
  return sum;
}

void ConstraintForceSolver::prepare(const Workspace<double>& w,
                                    const std::vector<std::size_t>& held,
                                    double tolerance) noexcept {
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    std::size_t k = 0;
    for_each_entry(
        j, [&](std::size_t, double entry) { elimination_.set_entry(rows_[j], k++, entry); });
  }
  elimination_.factorise(w, held, tolerance);
}

void ConstraintForceSolver::solve(const std::vector<double>& a,
                                  const std::vector<double>& b) noexcept {
  const std::size_t mimics = model_->mimics.size();
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    const double gamma = j < mimics ? 0 : loops_.gamma()[static_cast<Eigen::Index>(j - mimics)];
    elimination_.set_s(rows_[j], -row_times(j, a) - gamma);
  }
  elimination_.solve(b);
}

void ConstraintForceSolver::add_forces(std::vector<double>& mimic,
                                       std::vector<double>& loop) const {
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    std::vector<double>& tau = j < model_->mimics.size() ? mimic : loop;
    const double lambda = elimination_.lambda(rows_[j]);
    for_each_entry(j, [&](std::size_t d, double entry) { tau[d] += entry * lambda; });
  }
}

void ConstraintForceSolver::project_acceleration(std::vector<double>& a) noexcept {
  solve(a, no_forces_);
  add(y(), a);
}

void ConstraintForceSolver::project(std::vector<double>& y) noexcept {
  for (std::size_t j = 0; j < rows_.size(); ++j) elimination_.set_s(rows_[j], -row_times(j, y));
  elimination_.solve(no_forces_);
  add(elimination_.y(), y);
}

void ConstraintForceSolver::correction(const Eigen::VectorXd& residual,
                                       std::vector<double>& out) noexcept {
  const std::size_t mimics = model_->mimics.size();
  for (std::size_t j = 0; j < rows_.size(); ++j)
    elimination_.set_s(rows_[j], j < mimics ? 0 : -residual[static_cast<Eigen::Index>(j - mimics)]);
  elimination_.solve(no_forces_);
  out = y();
}

void ConstraintForceSolver::correction_of_loop(std::size_t loop, const std::vector<double>& lambda,
                                               std::vector<double>& out) noexcept {
  std::fill(forces_.begin(), forces_.end(), 0);
  for (std::size_t r = loops_.first_row(loop); r < loops_.rows() && loops_.loop_of(r) == loop;
       ++r) {
    std::size_t k = 0;
    for (const std::size_t d : loops_.dofs_of(r))
      forces_[d] += elimination_.entry(rows_[model_->mimics.size() + r], k++) * lambda[r];
  }
  elimination_.minv_times(forces_);
  out = y();
}

Eigen::VectorXd ConstraintForceSolver::lambda_of_loops() const {
  std::vector<double> lambda(loops_.rows());
  add_lambda(1, lambda);
  return min_solution(
      loops_.J().transpose(),
      loops_.J().transpose() * Eigen::Map<const Eigen::VectorXd>(
                                   lambda.data(), static_cast<Eigen::Index>(lambda.size())),
      1e-9);
}

}  // namespace twinarm
