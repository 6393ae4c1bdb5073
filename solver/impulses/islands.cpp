// Islands of impulse_solver.h, the order of their trees in the matrix, and the discs of each
// contact.
#include <algorithm>
#include <numeric>
#include <utility>

#include "solver/impulses/impulse_solver.h"

namespace twinarm {
namespace {

constexpr int world = ImpulseConstraint::no_tree;

}  // namespace

void ImpulseSolver::link_discs() {
  const std::vector<ImpulseConstraint>& all = problem_->constraints();
  next_disc_.assign(all.size(), -1);
  for (std::size_t i = all.size(); i-- > 0;)
    if (all[i].law == ConstraintType::friction_disc && all[i].radius > 0) {
      next_disc_[i] = next_disc_[all[i].of];
      next_disc_[all[i].of] = static_cast<int>(i);
    }
}

// Union-find over the constraints; members of an island are ascending.
void ImpulseSolver::find_islands() {
  const auto trees = static_cast<std::size_t>(problem_->tree_count());
  root_.resize(trees);
  std::iota(root_.begin(), root_.end(), 0);
  const auto find = [&](int t) {
    while (root_[t] != t) t = root_[t] = root_[root_[t]];
    return t;
  };
  for (const ImpulseConstraint& c : problem_->constraints())
    if (c.tree[0] != world && c.tree[1] != world) {
      const int a = find(c.tree[0]), b = find(c.tree[1]);
      root_[std::max(a, b)] = std::min(a, b);
    }
  island_of_.assign(trees, -1);
  island_count_ = 0;
  const auto island_at = [&](int tree) -> Island& {
    int& island = island_of_[find(tree)];
    if (island < 0) {
      island = static_cast<int>(island_count_++);
      if (islands_.size() < island_count_) islands_.emplace_back();
      islands_[island].trees.clear(), islands_[island].constraints.clear();
    }
    return islands_[island];
  };
  for (std::size_t i = 0; i < problem_->constraints().size(); ++i) {
    const ImpulseConstraint& c = problem_->constraints()[i];
    if (const int t = c.tree[0] != world ? c.tree[0] : c.tree[1]; t != world)
      island_at(t).constraints.push_back(static_cast<int>(i));
  }
  for (std::size_t t = 0; t < trees; ++t)  // trees without constraints keep v0
    if (const int island = island_of_[find(static_cast<int>(t))]; island >= 0)
      islands_[island].trees.push_back(static_cast<int>(t));
}

// Reverse Cuthill-McKee order, for a small matrix envelope.
void ImpulseSolver::order() {
  const auto trees = static_cast<std::size_t>(problem_->tree_count());
  neighbour_begin_.assign(trees + 1, 0);
  const auto for_each_pair = [&](auto&& f) {
    int last_a = world, last_b = world;
    for (const int i : island_->constraints) {
      const auto [a, b] = constraint(i).tree;
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
    for (const int t : island_->trees) lowest_[t] = 0;
    order_.assign(1, start), lowest_[start] = 1;
    for (std::size_t done = 0; done < order_.size(); ++done) {
      const std::size_t from = order_.size();
      for (int e = neighbour_begin_[order_[done]]; e < neighbour_begin_[order_[done] + 1]; ++e)
        if (const int t = neighbours_[e]; !lowest_[t]) lowest_[t] = 1, order_.push_back(t);
      std::sort(order_.begin() + static_cast<std::ptrdiff_t>(from), order_.end(),
                [&](int a, int b) { return std::pair(degree(a), a) < std::pair(degree(b), b); });
    }
  };
  breadth_first(island_->trees.front());
  breadth_first(order_.back());  // from a peripheral tree
  std::reverse(order_.begin(), order_.end());
  find_rows();
  count_work();
}

void ImpulseSolver::find_rows() {
  row_.resize(static_cast<std::size_t>(problem_->tree_count()));
  lowest_.resize(row_.size());
  std::size_t row = 0;
  for (const int t : order_) {
    row_[t] = row;
    lowest_[t] = t;
    row += static_cast<std::size_t>(problem_->size(t));
  }
  for (const int i : island_->constraints) {
    const auto [a, b] = constraint(i).tree;
    if (a == world || b == world) continue;
    const int later = row_[a] > row_[b] ? a : b, earlier = later == a ? b : a;
    if (row_[earlier] < row_[lowest_[later]]) lowest_[later] = earlier;
  }
  rhs_.resize(row);
  has_envelope_ = false;
}

void ImpulseSolver::set_envelope() {
  matrix_.clear();
  for (const int t : order_)
    for (int k = 0; k < problem_->size(t); ++k) matrix_.add_row(row_[lowest_[t]]);
  has_envelope_ = true;
}

}  // namespace twinarm
