// Structure of constraint_elimination.h: which rows meet at which body. Determined once.
#include "solver/loops/constraint_elimination.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "solver/dynamics/dynamics.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// Which batches are open and closed at which body, and which of them G couples.
struct ConstraintElimination::Structure {
  const Model<double>& model;
  ConstraintElimination& of;
  ConstraintWorkspace& c = of.c_;
  std::vector<std::size_t> closes_at{};  // by batch
  Lists open{}, closed{}, coupled{};     // by body, by body, by batch
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> K{}, blocks{};

  std::size_t index_of_K(std::size_t body, std::size_t number) {
    const auto [at, is_new] = K.try_emplace({body, number}, K.size());
    if (is_new) c.batch.push_back(number), c.above.push_back(0), c.is_first.push_back(0);
    return at->second;
  }
  std::vector<std::size_t> triangle(const std::vector<std::size_t>& numbers) {
    std::vector<std::size_t> indices;
    for (std::size_t j = 0; j < numbers.size(); ++j)
      for (std::size_t l = 0; l <= j; ++l) {
        const std::size_t a = numbers[j], b = numbers[l];
        const auto [at, is_new] = blocks.try_emplace({a, b}, blocks.size());
        if (is_new && a != b) coupled[a].push_back(b), coupled[b].push_back(a);
        indices.push_back(at->second);
      }
    return indices;
  }

  void number_batches(const Lists& dofs) {
    const auto parent = [&](std::size_t i) { return static_cast<std::size_t>(model.parent[i]); };
    std::vector<std::size_t> ends(dofs.size()), order(dofs.size());
    for (std::size_t b = 0; b < dofs.size(); ++b)
      for (std::size_t k = 0; k < dofs[b].size(); ++k) {
        const std::size_t above = parent(of.body_of_dof_[dofs[b][k]]);
        ends[b] = k == 0 ? above : model.shared_ancestor(ends[b], above);
      }
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t b) { return ends[b]; });
    open.resize(model.parent.size()), closed.resize(open.size()), coupled.resize(dofs.size());
    for (const std::size_t b : order) {
      const std::size_t number = of.number_[b] = closes_at.size(), end = ends[b];
      closes_at.push_back(end);
      closed[end].push_back(number);
      for (const std::size_t dof : dofs[b])
        for (std::size_t i = of.body_of_dof_[dof];
             i != end && (open[i].empty() || open[i].back() != number); i = parent(i))
          open[i].push_back(number);
    }
  }

  // Before the memory of G is taken.
  void check_size() const {
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const std::size_t coupled_here = open[i].size() + closed[i].size();
      pairs += coupled_here * (coupled_here + 1) / 2;
    }
    const std::size_t all = closes_at.size() * (closes_at.size() + 1) / 2;
    if (pairs * sizeof(c.block[0]) + std::min(pairs, all) * sizeof(c.f.G[0]) > kMaxBytes)
      throw InputError({{"", 0, "loops", "too many loops or mimic joints across the same bodies",
                         "give fewer of them, or connect bodies that are closer to each other",
                         "loop.too-many"}});
  }

  void add_fronts(const Lists& dofs) {
    std::size_t entries = 0, most = 0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      c.fronts.push_back({K.size(), open[i].size(), entries, 0});
      for (const std::size_t number : open[i]) index_of_K(i, number);
      entries += model.dofs(i) * open[i].size();
      most = std::max(most, model.dofs(i) * open[i].size());
    }
    c.f.E.resize(entries), c.f.Y.resize(entries), c.KS.resize(most);
    std::vector<char> has_terms(K.size() + closes_at.size());
    for (std::size_t i = open.size(); i-- > 1;)
      for (const std::size_t number : open[i]) {
        const std::size_t at = index_of_K(i, number),
                          above = index_of_K(static_cast<std::size_t>(model.parent[i]), number);
        c.above[at] = above;
        c.is_first[at] = !std::exchange(has_terms[above], 1);
      }
    for (std::size_t b = 0; b < dofs.size(); ++b)
      for (const std::size_t dof : dofs[b]) {
        const std::size_t i = of.body_of_dof_[dof],
                          j = index_of_K(i, of.number_[b]) - c.fronts[i].first;
        of.entries_[b].push_back(c.fronts[i].entry + j * model.dofs(i) + dof - model.iv[i]);
      }
  }

  // The batches that G couples to `first`, among those closed at the body, and the open ones.
  Group group(std::size_t body, std::size_t first, std::vector<char>& is_grouped) {
    Group g;
    g.body = body;
    g.batch = {first};
    is_grouped[first] = 1;
    for (std::size_t k = 0; k < g.batch.size(); ++k)
      for (const std::size_t other : coupled[g.batch[k]])
        if (closes_at[g.batch[k]] == body && closes_at[other] <= body && !is_grouped[other]) {
          is_grouped[other] = 1;
          g.batch.push_back(other);
        }
    std::ranges::sort(g.batch);
    for (const std::size_t number : g.batch) {
      g.K.push_back(index_of_K(body, number));
      if (closes_at[number] == body) continue;
      is_grouped[number] = 0;
      ++g.open;
    }
    g.G = triangle(g.batch);
    g.factors = PivotedCholesky(g.rows());
    g.GinvK.resize(g.rows());
    g.GinvG.resize(g.rows() * g.open);
    return g;
  }
  void add_groups() {
    std::vector<char> is_grouped(closes_at.size());
    for (std::size_t i = open.size(); i-- > 0;) {
      c.fronts[i].pair = c.block.size();
      const std::vector<std::size_t> pairs = triangle(open[i]);
      c.block.insert(c.block.end(), pairs.begin(), pairs.end());
      for (const std::size_t first : closed[i])
        if (!is_grouped[first]) of.groups_.push_back(group(i, first, is_grouped));
    }
    c.f.K.resize(K.size()), c.f.G.resize(blocks.size());
  }
};

ConstraintElimination::ConstraintElimination(const Model<double>& model, const Lists& dofs)
    : model_(&model), number_(dofs.size()), entries_(dofs.size()) {
  const std::size_t n = model.parent.size(), batches = dofs.size();
  for (std::size_t i = 0; i < n; ++i) body_of_dof_.insert(body_of_dof_.end(), model.dofs(i), i);
  Structure all{model, *this};
  all.number_batches(dofs);
  all.check_size();
  all.add_fronts(dofs);
  all.add_groups();

  const Workspace<double> w(model);
  c_.f.iD = w.iD;
  c_.f.Xup = w.Xup, c_.f.S_ = w.S_;
  c_.f.U = c_.f.changed_U = w.U, c_.f.D_factors = c_.f.changed_D = w.D_factors;
  c_.f.is_changed.resize(n), unchanged_.resize(n);
  c_.dIA.resize(n), c_.p.resize(n), c_.dv.resize(n);
  c_.size.resize(batches), c_.s.resize(batches), c_.lambda.resize(batches);
  c_.is_held.resize(model.nv), c_.y.resize(model.nv);
  held_.reserve(model.nv);
  std::size_t most = 0;
  for (const Group& group : groups_) most = std::max(most, group.rows());
  size_.resize(most), lambda_.resize(most), work_.resize(most);
  K_.resize(most), work_K_.resize(most), work_G_.resize(most);
}

}  // namespace twinarm
