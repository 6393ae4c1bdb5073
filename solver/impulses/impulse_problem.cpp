#include "solver/impulses/impulse_problem.h"

#include <cassert>

#include "solver/linear_algebra/block_matrices.h"

namespace twinarm {

void ImpulseProblem::clear() {
  size_.clear(), first_.clear(), block_.clear();
  blocks_size_ = 0;
  M_.clear(), v0_.clear(), v_.clear(), J_.clear();
  constraints_.clear();
}

int ImpulseProblem::add_tree(int n) {
  const auto rows = static_cast<std::size_t>(n);
  size_.push_back(n);
  first_.push_back(v0_.size());
  block_.push_back(blocks_size_);
  blocks_size_ += rows * rows;
  v0_.resize(v0_.size() + rows, 0.0);
  v_.resize(v0_.size(), 0.0);
  return tree_count() - 1;
}

ImpulseConstraint& ImpulseProblem::add(ConstraintType law, int rows, int tree_a, int tree_b) {
  assert(rows >= 1 && rows <= 3);
  ImpulseConstraint& c = constraints_.emplace_back();
  c.law = law;
  c.rows = rows;
  c.tree = {tree_a, tree_b};
  std::size_t end = J_.size();
  for (int side = 0; side < 2; ++side) {
    c.J[side] = end;
    if (c.tree[side] != ImpulseConstraint::no_tree)
      end += static_cast<std::size_t>(rows * size_[c.tree[side]]);
  }
  J_.resize(end, 0.0);
  return c;
}

void ImpulseProblem::velocity(const ImpulseConstraint& c, const double* v,
                              std::array<double, 3>& u) const {
  u = {};
  for (int side = 0; side < 2; ++side) {
    const int tree = c.tree[side];
    if (tree == ImpulseConstraint::no_tree) continue;
    const double* v_tree = v + first_[tree];
    with_shape(c.rows, size_[tree],
               [&](auto rows, auto n) { add_product(J(c, side), rows, n, v_tree, u.data()); });
  }
}

void ImpulseProblem::add_transpose(const ImpulseConstraint& c, const std::array<double, 3>& p,
                                   double* f) const {
  for (int side = 0; side < 2; ++side) {
    const int tree = c.tree[side];
    if (tree == ImpulseConstraint::no_tree) continue;
    double* f_tree = f + first_[tree];
    with_shape(c.rows, size_[tree], [&](auto rows, auto n) {
      add_transposed_product(J(c, side), rows, n, p.data(), f_tree);
    });
  }
}

}  // namespace twinarm
