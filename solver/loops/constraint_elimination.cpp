#include "solver/loops/constraint_elimination.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "solver/dynamics/dynamics.h"

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

void ConstraintElimination::factorise(const Workspace<double>& w,
                                      const std::vector<std::size_t>& held,
                                      double tolerance) noexcept {
  c_.f.Xup = w.Xup, c_.f.S_ = w.S_, c_.f.U = w.U, c_.f.D_factors = w.D_factors;
  std::ranges::fill(c_.f.is_changed, 0);
  std::ranges::fill(c_.f.G, ConstraintWorkspace::Block{});
  std::ranges::fill(c_.size, Rows{});
  for (const std::size_t dof : held_) c_.is_held[dof] = 0;
  held_.assign(held.begin(), held.end());
  for (const std::size_t dof : held_) {
    c_.is_held[dof] = 1;
    c_.dIA[body_of_dof_[dof]] = ArticulatedInertia<double>{};
    c_.f.is_changed[body_of_dof_[dof]] = 1;
  }
  const Passes<double>& pass = passes<double>();
  std::size_t end = model_->parent.size();
  for (Group& group : groups_) {
    pass.constraint_factors(*model_, w, c_, group.body + 1, end);
    end = group.body + 1;
    factorise(group, tolerance);
  }
  pass.constraint_factors(*model_, w, c_, 1, end);
}

void ConstraintElimination::factorise(Group& of, double tolerance) {
  const std::size_t n = of.rows();
  for (std::size_t a = 0; a < n; ++a) {
    size_[a] = lane_of(c_.size[of.batch_of(a)], a % 4);
    for (std::size_t b = 0; b <= a; ++b)
      of.factors(a, b) = of.factors(b, a) = lane_of(G_row(of, a, of.open + b / 4), b % 4);
  }
  of.factors.factorise(n, tolerance, size_.data());
  if (of.body == 0) return;

  for (std::size_t r = 0; r < n; ++r) K_[r] = of.GinvK[r] = row_of_K(of, r);
  of.factors.solve(of.GinvK.data(), work_K_.data());
  ArticulatedInertia<double> more;
  for (std::size_t r = 0; r < n; ++r) more += outer(K_[r], of.GinvK[r]);
  c_.add_inertia(of.body, {}, more);
  for (std::size_t o = 0; o < of.open; ++o) {
    Rows* const GinvG = &of.GinvG[o * n];
    for (std::size_t r = 0; r < n; ++r) GinvG[r] = G_row(of, r, o);
    of.factors.solve(GinvG, work_G_.data());
    Force<Rows>& K = c_.f.K[of.K[o]];
    for (std::size_t r = 0; r < n; ++r) K = K - G_row(of, r, o) * convert<Rows>(of.GinvK[r]);
  }
  for (std::size_t o = 0, pair = 0; o < of.open; ++o)
    for (std::size_t l = 0; l <= o; ++l, ++pair)
      for (std::size_t r = 0; r < n; ++r)
        for (std::size_t lane = 0; lane < 4; ++lane) {
          Rows& G = c_.f.G[of.G[pair]][lane];
          G = G - Rows(lane_of(G_row(of, r, o), lane)) * of.GinvG[l * n + r];
        }
}

// Row of G of an eliminated row and the batch of that index.
const ConstraintElimination::Rows& ConstraintElimination::G_row(const Group& of, std::size_t row,
                                                                std::size_t index) const {
  const std::size_t j = of.open + row / 4;
  return c_.f.G[of.G[j * (j + 1) / 2 + index]][row % 4];
}

std::size_t ConstraintElimination::rank() const {
  std::size_t rank = held_.size();
  for (const Group& group : groups_) rank += group.factors.rank();
  return rank;
}

void ConstraintElimination::copy_factors(const ConstraintElimination& from) noexcept {
  c_.f = from.c_.f;
  held_ = from.held_;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    groups_[g].factors = from.groups_[g].factors;
    groups_[g].GinvK = from.groups_[g].GinvK;
    groups_[g].GinvG = from.groups_[g].GinvG;
  }
}

void ConstraintElimination::solve(const std::vector<double>& b) noexcept {
  const Passes<double>& pass = passes<double>();
  std::ranges::fill(c_.p, Force<double>{});
  std::ranges::fill(c_.y, 0);
  // Without forces, p and y remain zero up to the first group that is closed at a body.
  bool has_forces = std::ranges::any_of(b, [](double force) { return force != 0; });
  std::size_t end = model_->parent.size();
  for (const Group& group : groups_) {
    if (has_forces) pass.constraint_forces(*model_, c_, b, group.body + 1, end);
    end = group.body + 1;
    eliminate(group);
    has_forces = has_forces || group.body > 0;
  }
  if (has_forces) pass.constraint_forces(*model_, c_, b, 1, end);
  c_.dv[0] = {};
  std::size_t first = 1;
  for (std::size_t g = groups_.size(); g-- > 0;) {
    pass.constraint_accelerations(*model_, c_, first, groups_[g].body + 1);
    first = groups_[g].body + 1;
    determine_multipliers(groups_[g]);
  }
  pass.constraint_accelerations(*model_, c_, first, model_->parent.size());
}

void ConstraintElimination::eliminate(const Group& of) {
  for (std::size_t r = 0; r < of.rows(); ++r) lambda_[r] = lane_of(c_.s[of.batch_of(r)], r % 4);
  of.factors.solve(lambda_.data(), work_.data());
  for (std::size_t r = 0; r < of.rows(); ++r) {
    set_lane(c_.lambda[of.batch_of(r)], r % 4, lambda_[r]);
    if (of.body > 0) c_.p[of.body] += -lambda_[r] * row_of_K(of, r);
    for (std::size_t o = 0; o < of.open; ++o)
      c_.s[of.batch[o]] = c_.s[of.batch[o]] - Rows(lambda_[r]) * G_row(of, r, o);
  }
}

void ConstraintElimination::determine_multipliers(const Group& of) {
  if (of.body == 0) return;
  for (std::size_t r = 0; r < of.rows(); ++r) {
    double lambda = lane_of(c_.lambda[of.batch_of(r)], r % 4) - dot(c_.dv[of.body], of.GinvK[r]);
    for (std::size_t o = 0; o < of.open; ++o) {
      const Rows part = of.GinvG[o * of.rows() + r] * c_.lambda[of.batch[o]];
      lambda -= (part[0] + part[1]) + (part[2] + part[3]);
    }
    set_lane(c_.lambda[of.batch_of(r)], r % 4, lambda);
  }
}

// The row of K_e as a force.
Force<double> ConstraintElimination::row_of_K(const Group& of, std::size_t row) const {
  const Force<Rows>& K = c_.f.K[of.K[of.open + row / 4]];
  const auto lane = [&](const Vec3<Rows>& v) {
    return Vec3<double>{lane_of(v.x, row % 4), lane_of(v.y, row % 4), lane_of(v.z, row % 4)};
  };
  return {lane(K.n), lane(K.f)};
}

void ConstraintElimination::minv_times(const std::vector<double>& b) noexcept {
  const Passes<double>& pass = passes<double>();
  const std::size_t n = model_->parent.size();
  std::swap(c_.f.is_changed, unchanged_);
  std::ranges::fill(c_.p, Force<double>{});
  std::ranges::fill(c_.lambda, Rows{});
  c_.dv[0] = {};
  pass.constraint_forces(*model_, c_, b, 1, n);
  pass.constraint_accelerations(*model_, c_, 1, n);
  std::swap(c_.f.is_changed, unchanged_);
}

}  // namespace twinarm
