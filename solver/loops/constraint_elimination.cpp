#include "solver/loops/constraint_elimination.h"

#include <algorithm>
#include <utility>

#include "solver/dynamics/dynamics.h"

namespace twinarm {

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
