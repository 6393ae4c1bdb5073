#include "solver/impulses/newton_matrix.h"

#include <utility>

#include "solver/linear_algebra/block_matrices.h"

namespace twinarm {
namespace {

constexpr int world = ImpulseConstraint::no_tree;

}  // namespace

// Reverse Cuthill-McKee order, for a small matrix envelope.
void NewtonMatrix::set(ImpulseIsland& island) {
  island_ = &island, problem_ = island.problem;
  const auto trees = static_cast<std::size_t>(problem_->tree_count());
  neighbour_begin_.assign(trees + 1, 0);
  const auto for_each_pair = [&](auto&& f) {
    int last_a = world, last_b = world;
    for (const int i : island.constraints()) {
      const auto [a, b] = island.constraint(i).tree;
      if (a == world || b == world || a == b || (a == last_a && b == last_b)) continue;
      f(a, b), last_a = a, last_b = b;
    }
  };
  for_each_pair([&](int a, int b) { ++neighbour_begin_[a + 1], ++neighbour_begin_[b + 1]; });
  for (std::size_t t = 0; t < trees; ++t) neighbour_begin_[t + 1] += neighbour_begin_[t];
  neighbours_.resize(neighbour_begin_[trees]);
  lowest_.assign(neighbour_begin_.begin(), neighbour_begin_.end());
  for_each_pair(
      [&](int a, int b) { neighbours_[lowest_[a]++] = b, neighbours_[lowest_[b]++] = a; });
  const auto degree = [&](int t) { return neighbour_begin_[t + 1] - neighbour_begin_[t]; };

  const auto breadth_first = [&](int start) {
    for (const int t : island.trees()) lowest_[t] = 0;
    order_.assign(1, start), lowest_[start] = 1;
    for (std::size_t done = 0; done < order_.size(); ++done) {
      const std::size_t from = order_.size();
      for (int e = neighbour_begin_[order_[done]]; e < neighbour_begin_[order_[done] + 1]; ++e)
        if (const int t = neighbours_[e]; !lowest_[t]) lowest_[t] = 1, order_.push_back(t);
      std::sort(order_.begin() + static_cast<std::ptrdiff_t>(from), order_.end(),
                [&](int a, int b) { return std::pair(degree(a), a) < std::pair(degree(b), b); });
    }
  };
  breadth_first(island.trees().front());
  breadth_first(order_.back());  // from a peripheral tree
  std::reverse(order_.begin(), order_.end());
  find_rows();
}

void NewtonMatrix::find_rows() {
  row_.resize(static_cast<std::size_t>(problem_->tree_count()));
  lowest_.resize(row_.size());
  std::size_t row = 0;
  for (const int t : order_) {
    row_[t] = row;
    lowest_[t] = t;
    row += static_cast<std::size_t>(problem_->size(t));
  }
  for (const int i : island_->constraints()) {
    const auto [a, b] = island_->constraint(i).tree;
    if (a == world || b == world) continue;
    const int later = row_[a] > row_[b] ? a : b, earlier = later == a ? b : a;
    if (row_[earlier] < row_[lowest_[later]]) lowest_[later] = earlier;
  }
  rhs_.resize(row);
  has_envelope_ = false;
  count_work();
}

void NewtonMatrix::count_work() {
  work_ = 0;
  for (const int t : order_) {
    const auto n = static_cast<double>(problem_->size(t));
    const double width = static_cast<double>(row_[t] - row_[lowest_[t]]) + 0.5 * n;
    work_ += 2 * n * width * width;
  }
  for (const int i : island_->constraints()) {
    const ImpulseConstraint& c = island_->constraint(i);
    double n = 0;  // velocities
    for (const int t : c.tree) n += t == world ? 0 : problem_->size(t);
    work_ += 2 * c.rows * n * (n + 3);
  }
}

void NewtonMatrix::set_envelope() {
  matrix_.clear();
  for (const int t : order_)
    for (int k = 0; k < problem_->size(t); ++k) matrix_.add_row(row_[lowest_[t]]);
  has_envelope_ = true;
}

bool NewtonMatrix::factorise(bool symmetric) {
  island_->work += symmetric ? 0.5 * work_ : work_;
  if (!has_envelope_) set_envelope();
  matrix_.set_zero();
  for (const int t : island_->trees()) {
    const std::size_t at = row_[t];
    const int n = problem_->size(t);
    const double* M = problem_->M(t);
    for (int r = 0; r < n; ++r)
      for (int k = 0; k <= r; ++k) {
        const std::size_t row = at + static_cast<std::size_t>(r);
        matrix_.row(row, at)[k] += M[r * n + k];
        if (!symmetric && k < r) matrix_.column(row, at)[k] += M[r * n + k];
      }
  }
  for (const int i : island_->constraints())
    add_products(island_->constraint(i), island_->constraint(i), island_->D[i], symmetric);
  if (!symmetric)
    for (const auto& block : island_->coupling)
      add_products(island_->constraint(block.of), island_->constraint(block.by), block.D,
                   symmetric);
  return matrix_.factorise(symmetric);
}

// J_left^T D J_right, both sides of each.
void NewtonMatrix::add_products(const ImpulseConstraint& left, const ImpulseConstraint& right,
                                const Mat& D, bool symmetric) {
  for (int side = 0; side < 2; ++side) {
    if (right.tree[side] == world) continue;
    const int n = problem_->size(right.tree[side]);
    DJ_.resize(std::max(DJ_.size(), static_cast<std::size_t>(3 * n)));
    if (&left == &right)
      with_shape(left.rows, n, [&](auto rows, auto size) {
        product(D.data(), rows, problem_->J(right, side), rows, size, DJ_.data());
      });
    else
      product(D.data(), left.rows, problem_->J(right, side), right.rows, n, DJ_.data());
    for (int other = 0; other < 2; ++other)
      if (left.tree[other] != world) add_block(left, other, right, side, symmetric);
  }
}

// J_s^T (D J)_t, s and t the trees of two sides; the upper triangle is column-major.
void NewtonMatrix::add_block(const ImpulseConstraint& left, int side_s,
                             const ImpulseConstraint& right, int side_t, bool symmetric) {
  const int s = left.tree[side_s], t = right.tree[side_t];
  const std::size_t row = row_[s], column = row_[t];
  if (symmetric && row < column) return;
  const double *J = problem_->J(left, side_s), *DJ = DJ_.data();
  const auto below = [&](int k) { return matrix_.row(row + static_cast<std::size_t>(k), column); };
  const auto above = [&](int k) {
    return matrix_.column(column + static_cast<std::size_t>(k), row);
  };
  with_shapes(left.rows, problem_->size(s), problem_->size(t), [&](auto rows, auto m, auto n) {
    if (row > column) {
      add_product_rows(J, m, DJ, n, rows, below, [&](int) { return n; });
    } else if (row < column) {
      add_product_rows(DJ, n, J, m, rows, above, [&](int) { return m; });
    } else {
      add_product_rows(J, m, DJ, n, rows, below, [](int r) { return r + 1; });
      if (!symmetric) add_product_rows(DJ, n, J, m, rows, above, [](int k) { return k; });
    }
  });
}

void NewtonMatrix::solve(std::vector<double>& x) {
  for_each_row([&](std::size_t k, std::size_t row) { rhs_[row] = x[k]; });
  matrix_.solve(rhs_.data());
  for_each_row([&](std::size_t k, std::size_t row) { x[k] = rhs_[row]; });
}

}  // namespace twinarm
