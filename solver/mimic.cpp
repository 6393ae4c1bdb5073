#include "solver/mimic.h"

#include <algorithm>

#include "solver/dynamics.h"

namespace twinarm {

void apply_mimics(const Model<double>& model, State<double>& x) {
  for (const Mimic& m : model.mimics) {
    x.q[m.follower_q] = m.ratio * x.q[m.leader_q] + m.offset;
    x.qd[m.follower] = m.ratio * x.qd[m.leader];
  }
}

std::vector<std::size_t> independent_dofs(const Model<double>& model) {
  std::vector<std::size_t> dofs;
  for (std::size_t d = 0; d < model.nv; ++d)
    if (std::none_of(model.mimics.begin(), model.mimics.end(),
                     [d](const Mimic& m) { return m.follower == d; }))
      dofs.push_back(d);
  return dofs;
}

Eigen::MatrixXd mimic_projection(const Model<double>& model) {
  const std::vector<std::size_t> independent = independent_dofs(model);
  const auto index = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(index(model.nv), index(independent.size()));
  for (std::size_t y = 0; y < independent.size(); ++y) {
    G(index(independent[y]), index(y)) = 1;
    for (const Mimic& m : model.mimics)
      if (m.leader == independent[y]) G(index(m.follower), index(y)) = m.ratio;
  }
  return G;
}

MimicForces::MimicForces(const Model<double>& model)
    : model_(&model),
      S_(model.mimics.size()),
      Z_(model.mimics.size() * model.nv),
      lambda_(model.mimics.size()),
      b_(model.nv),
      no_forces_(model.parent.size()) {}

void MimicForces::prepare(Workspace<double>& w) noexcept {
  const std::vector<Mimic>& mimics = model_->mimics;
  for (std::size_t j = 0; j < mimics.size(); ++j) {
    b_[mimics[j].follower] += 1;
    b_[mimics[j].leader] -= mimics[j].ratio;
    minv_times(*model_, b_, no_forces_, w);
    b_[mimics[j].follower] = b_[mimics[j].leader] = 0;
    std::copy(w.y.begin(), w.y.end(), Z_.begin() + static_cast<std::ptrdiff_t>(j * model_->nv));
    for (std::size_t i = 0; i < mimics.size(); ++i)
      S_(i, j) = w.y[mimics[i].follower] - mimics[i].ratio * w.y[mimics[i].leader];
  }
  S_.factorise(mimics.size());
}

void MimicForces::solve(const std::vector<double>& a, const std::vector<double>& b) noexcept {
  const std::vector<Mimic>& mimics = model_->mimics;
  for (std::size_t j = 0; j < mimics.size(); ++j) {
    lambda_[j] = mimics[j].ratio * a[mimics[j].leader] - a[mimics[j].follower];
    for (std::size_t d = 0; d < model_->nv; ++d) lambda_[j] -= Z_[j * model_->nv + d] * b[d];
  }
  S_.solve(lambda_.data());
}

double MimicForces::acceleration(std::size_t dof) const {
  double sum = 0;
  for (std::size_t j = 0; j < lambda_.size(); ++j) sum += Z_[j * model_->nv + dof] * lambda_[j];
  return sum;
}

void MimicForces::add_forces(std::vector<double>& tau) const {
  for (std::size_t j = 0; j < lambda_.size(); ++j) {
    tau[model_->mimics[j].follower] += lambda_[j];
    tau[model_->mimics[j].leader] -= model_->mimics[j].ratio * lambda_[j];
  }
}

void MimicForces::project(std::vector<double>& y) noexcept {
  solve(y, b_);  // b_ is zero between calls
  for (std::size_t d = 0; d < model_->nv; ++d) y[d] += acceleration(d);
}

}  // namespace twinarm
