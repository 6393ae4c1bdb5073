#include "solver/impulse_problem.h"

#include <cassert>

namespace twinarm {

void ImpulseProblem::clear() {
  size_.clear(), first_.clear(), block_.clear();
  M_.clear(), v0_.clear(), v_.clear(), J_.clear();
  constraints_.clear();
}

int ImpulseProblem::add_tree(int n) {
  const auto rows = static_cast<std::size_t>(n);
  size_.push_back(n);
  first_.push_back(v0_.size());
  block_.push_back(M_.size());
  M_.resize(M_.size() + rows * rows, 0.0);
  v0_.resize(v0_.size() + rows, 0.0);
  v_.resize(v0_.size(), 0.0);
  return tree_count() - 1;
}

ImpulseConstraint& ImpulseProblem::add(ImpulseLaw law, int rows, int tree_a, int tree_b) {
  assert(rows >= 1 && rows <= 3);
  ImpulseConstraint& c = constraints_.emplace_back();
  c.law = law;
  c.rows = rows;
  c.tree = {tree_a, tree_b};
  for (int side = 0; side < 2; ++side) {
    c.J[side] = J_.size();
    if (c.tree[side] != ImpulseConstraint::no_tree)
      J_.resize(J_.size() + static_cast<std::size_t>(rows * size_[c.tree[side]]), 0.0);
  }
  return c;
}

void ImpulseProblem::velocity(const ImpulseConstraint& c, const double* v,
                              std::array<double, 3>& u) const {
  u = {};
  for (int side = 0; side < 2; ++side) {
    const int tree = c.tree[side];
    if (tree == ImpulseConstraint::no_tree) continue;
    const int n = size_[tree];
    const double* J_side = J(c, side);
    const double* v_tree = v + first_[tree];
    for (int r = 0; r < c.rows; ++r)
      for (int k = 0; k < n; ++k) u[r] += J_side[r * n + k] * v_tree[k];
  }
}

void ImpulseProblem::add_transpose(const ImpulseConstraint& c, const std::array<double, 3>& p,
                                   double* f) const {
  for (int side = 0; side < 2; ++side) {
    const int tree = c.tree[side];
    if (tree == ImpulseConstraint::no_tree) continue;
    const int n = size_[tree];
    const double* J_side = J(c, side);
    double* f_tree = f + first_[tree];
    for (int r = 0; r < c.rows; ++r)
      for (int k = 0; k < n; ++k) f_tree[k] += J_side[r * n + k] * p[r];
  }
}

}  // namespace twinarm
