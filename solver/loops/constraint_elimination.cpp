#include "solver/loops/constraint_elimination.h"

#include <algorithm>
#include <numeric>

#include "solver/dynamics/dynamics.h"

namespace twinarm {

// Which batches are open and closed at which body, and which of them G couples.
struct ConstraintElimination::Structure {
  const Model<double>& model;
  ConstraintWorkspace& c;
  std::vector<std::size_t> closes_at;  // by batch
  Lists open, closed, coupled;         // by body, by body, by batch
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> blocks;

  std::size_t index_of_K(std::size_t body, std::size_t number) const {
    const auto first = c.batch.begin() + static_cast<std::ptrdiff_t>(c.fronts[body].first);
    const auto count = static_cast<std::ptrdiff_t>(open[body].size() + closed[body].size());
    return static_cast<std::size_t>(std::lower_bound(first, first + count, number) -
                                    c.batch.begin());
  }
  std::size_t block(std::size_t a, std::size_t b) {
    const auto [at, is_new] = blocks.try_emplace({a, b}, blocks.size());
    if (is_new && a != b) coupled[a].push_back(b), coupled[b].push_back(a);
    return at->second;
  }
  std::vector<std::size_t> triangle(const std::vector<std::size_t>& of) {
    std::vector<std::size_t> indices;
    for (std::size_t j = 0; j < of.size(); ++j)
      for (std::size_t l = 0; l <= j; ++l) indices.push_back(block(of[j], of[l]));
    return indices;
  }

  void add_fronts() {
    std::size_t entries = 0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      c.fronts[i] = {c.batch.size(), open[i].size(), entries, 0};
      c.batch.insert(c.batch.end(), open[i].begin(), open[i].end());
      c.batch.insert(c.batch.end(), closed[i].begin(), closed[i].end());
      entries += model.dofs(i) * open[i].size();
      c.KS.resize(std::max(c.KS.size(), model.dofs(i) * open[i].size()));
    }
    c.f.E.resize(entries), c.f.Y.resize(entries);
    c.f.K.resize(c.batch.size());
    c.above.resize(c.batch.size());
    c.is_first.resize(c.batch.size());
    std::vector<char> has_terms(c.batch.size());
    for (std::size_t i = open.size(); i-- > 1;)
      for (std::size_t j = 0; j < open[i].size(); ++j) {
        const std::size_t at = c.fronts[i].first + j;
        c.above[at] = index_of_K(static_cast<std::size_t>(model.parent[i]), open[i][j]);
        c.is_first[at] = !has_terms[c.above[at]];
        has_terms[c.above[at]] = 1;
      }
  }

  // The group of the batches that G couples to `first`, among those closed at the body.
  Group group(std::size_t body, std::size_t first, std::vector<char>& is_grouped) {
    Group g;
    g.body = body;
    g.closed = {first};
    is_grouped[first] = 1;
    for (std::size_t k = 0; k < g.closed.size(); ++k)
      for (const std::size_t other : coupled[g.closed[k]])
        if (closes_at[other] < body) {
          g.open.push_back(other);
        } else if (closes_at[other] == body && !is_grouped[other]) {
          is_grouped[other] = 1;
          g.closed.push_back(other);
        }
    std::ranges::sort(g.closed);
    std::ranges::sort(g.open);
    g.open.erase(std::unique(g.open.begin(), g.open.end()), g.open.end());
    g.G = triangle(g.closed);
    g.G_open = triangle(g.open);
    for (const std::size_t e : g.closed) {
      g.K.push_back(index_of_K(body, e));
      for (const std::size_t o : g.open) g.G_mixed.push_back(block(e, o));
    }
    for (const std::size_t o : g.open) g.K_open.push_back(index_of_K(body, o));
    g.factors = PivotedCholesky(g.rows());
    g.GinvK.resize(g.rows());
    g.GinvG.resize(g.rows() * g.open.size());
    return g;
  }
};

ConstraintElimination::ConstraintElimination(const Model<double>& model, const Lists& dofs)
    : model_(&model), number_(dofs.size()), entries_(dofs.size()) {
  const std::size_t n = model.parent.size(), batches = dofs.size();
  for (std::size_t i = 0; i < n; ++i) body_of_dof_.insert(body_of_dof_.end(), model.dofs(i), i);
  std::vector<std::size_t> closes_at(batches), order(batches);
  for (std::size_t b = 0; b < batches; ++b)
    for (const std::size_t& dof : dofs[b]) {
      const auto above = static_cast<std::size_t>(model.parent[body_of_dof_[dof]]);
      closes_at[b] =
          &dof == dofs[b].data() ? above : model.shared_ancestor(closes_at[b], above);
    }
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t b) { return closes_at[b]; });

  c_.fronts.resize(n);
  Structure all{model, c_, {}, Lists(n), Lists(n), Lists(batches), {}};
  for (const std::size_t b : order) {
    const std::size_t number = number_[b] = all.closes_at.size(), end = closes_at[b];
    all.closes_at.push_back(end);
    all.closed[end].push_back(number);
    for (const std::size_t dof : dofs[b])
      for (std::size_t i = body_of_dof_[dof];
           i != end && (all.open[i].empty() || all.open[i].back() != number);
           i = static_cast<std::size_t>(model.parent[i]))
        all.open[i].push_back(number);
  }
  all.add_fronts();
  for (std::size_t b = 0; b < batches; ++b)
    for (const std::size_t dof : dofs[b]) {
      const std::size_t i = body_of_dof_[dof];
      const ConstraintWorkspace::Front& front = c_.fronts[i];
      entries_[b].push_back(front.entry +
                            (all.index_of_K(i, number_[b]) - front.first) * model.dofs(i) + dof -
                            model.iv[i]);
    }
  std::vector<char> is_grouped(batches);
  std::size_t most = 0;
  for (std::size_t i = n; i-- > 0;) {
    c_.fronts[i].pair = c_.block.size();
    const std::vector<std::size_t> pairs = all.triangle(all.open[i]);
    c_.block.insert(c_.block.end(), pairs.begin(), pairs.end());
    for (const std::size_t first : all.closed[i]) {
      if (is_grouped[first]) continue;
      groups_.push_back(all.group(i, first, is_grouped));
      most = std::max(most, groups_.back().rows());
    }
  }

  const Workspace<double> w(model);
  c_.f.iD = w.iD;
  c_.f.G.resize(all.blocks.size());
  c_.f.changed_U.resize(model.nv), c_.f.changed_D.resize(w.D_factors.size());
  c_.f.is_changed.resize(n), c_.dIA.resize(n), c_.p.resize(n), c_.dv.resize(n);
  c_.f.Xup = w.Xup, c_.f.S_ = w.S_, c_.f.U = w.U, c_.f.D_factors = w.D_factors;
  c_.size.resize(batches), c_.s.resize(batches), c_.lambda.resize(batches);
  c_.is_held.resize(model.nv), c_.y.resize(model.nv);
  unchanged_.resize(n);
  held_.reserve(model.nv);
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
  const std::size_t n = of.rows(), open = of.open.size();
  const std::size_t* block = of.G.data();
  for (std::size_t a = 0; a < n; a += 4)
    for (std::size_t b = 0; b <= a; b += 4, ++block)
      for (std::size_t r = 0; r < 16; ++r)
        of.factors(a + r / 4, b + r % 4) = of.factors(b + r % 4, a + r / 4) =
            lane_of(c_.f.G[*block][r / 4], r % 4);
  for (std::size_t r = 0; r < n; ++r) size_[r] = lane_of(c_.size[of.closed[r / 4]], r % 4);
  of.factors.factorise(n, tolerance, size_.data());
  if (of.body == 0) return;

  const auto G_mixed = [&](std::size_t r, std::size_t o) -> const Rows& {
    return c_.f.G[of.G_mixed[r / 4 * open + o]][r % 4];
  };
  for (std::size_t r = 0; r < n; ++r) K_[r] = of.GinvK[r] = row_of_K(of, r);
  of.factors.solve(of.GinvK.data(), work_K_.data());
  ArticulatedInertia<double> more;
  for (std::size_t r = 0; r < n; ++r) more += outer(K_[r], of.GinvK[r]);
  c_.add_inertia(of.body, {}, more);
  for (std::size_t o = 0; o < open; ++o) {
    Rows* const GinvG = &of.GinvG[o * n];
    for (std::size_t r = 0; r < n; ++r) GinvG[r] = G_mixed(r, o);
    of.factors.solve(GinvG, work_G_.data());
    Force<Rows>& K = c_.f.K[of.K_open[o]];
    for (std::size_t r = 0; r < n; ++r) K = K - G_mixed(r, o) * convert<Rows>(of.GinvK[r]);
  }
  block = of.G_open.data();
  for (std::size_t o = 0; o < open; ++o)
    for (std::size_t l = 0; l <= o; ++l, ++block)
      for (std::size_t r = 0; r < n; ++r)
        for (std::size_t lane = 0; lane < 4; ++lane) {
          Rows& G = c_.f.G[*block][lane];
          G = G - Rows(lane_of(G_mixed(r, o), lane)) * of.GinvG[l * n + r];
        }
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
  const std::size_t n = of.rows(), open = of.open.size();
  for (std::size_t r = 0; r < n; ++r) lambda_[r] = lane_of(c_.s[of.closed[r / 4]], r % 4);
  of.factors.solve(lambda_.data(), work_.data());
  for (std::size_t r = 0; r < n; ++r) {
    set_lane(c_.lambda[of.closed[r / 4]], r % 4, lambda_[r]);
    if (of.body > 0) c_.p[of.body] += -lambda_[r] * row_of_K(of, r);
    for (std::size_t o = 0; o < open; ++o) {
      Rows& s = c_.s[of.open[o]];
      s = s - Rows(lambda_[r]) * c_.f.G[of.G_mixed[r / 4 * open + o]][r % 4];
    }
  }
}

void ConstraintElimination::determine_multipliers(const Group& of) {
  if (of.body == 0) return;
  for (std::size_t r = 0; r < of.rows(); ++r) {
    Rows sum(0);
    for (std::size_t o = 0; o < of.open.size(); ++o)
      sum = sum + of.GinvG[o * of.rows() + r] * c_.lambda[of.open[o]];
    Rows& lambda = c_.lambda[of.closed[r / 4]];
    set_lane(lambda, r % 4,
             lane_of(lambda, r % 4) - dot(c_.dv[of.body], of.GinvK[r]) -
                 ((sum[0] + sum[1]) + (sum[2] + sum[3])));
  }
}

// The row of K_e as a force.
Force<double> ConstraintElimination::row_of_K(const Group& of, std::size_t row) const {
  const Force<Rows>& K = c_.f.K[of.K[row / 4]];
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
