// Inner problem of impulse_solver.h: semismooth Newton method on one island.
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/impulses/block_matrices.h"
#include "solver/impulses/impulse_solver.h"

namespace twinarm {
namespace {

constexpr int no_tree = ImpulseConstraint::no_tree;

}  // namespace

// Convex problem with frozen shifts; then Newton steps with differentiated shift from its solution.
// These have no merit function: they are accepted only while |gradient| decreases, with step
// halving if the budget permits; otherwise the convex solution is restored.
ImpulseSolver::InnerResult ImpulseSolver::solve_inner_problem(int max_steps) {
  InnerResult result;
  int& steps = result.steps;
  for (Gradient now = gradient(DeSaxceShift::frozen);
       steps < max_steps && now.largest > now.tolerance; now = gradient(DeSaxceShift::frozen)) {
    find_direction(true);
    const double step = step_length();
    move(step);
    ++steps;
    if (step == 1 && now.largest < 1e2 * now.tolerance) break;
  }
  for_each_velocity([&](std::size_t k, std::size_t) { convex_v_[k] = problem_->v(0)[k]; });
  Gradient now = gradient(DeSaxceShift::differentiated);
  result.error = now.error();
  while (steps < max_steps && now.largest > now.tolerance) {
    find_direction(false);
    move(1);
    ++steps;
    Gradient then = gradient(DeSaxceShift::differentiated);
    double step = 1;
    if (max_steps > quick_newton_small)
      for (; !(then.squared < (1 - 0.5 * step) * now.squared) && step > 0.05; step *= 0.5) {
        move(-0.5 * step);
        then = gradient(DeSaxceShift::differentiated);
      }
    if (!(then.squared < (step < 1 ? 1 - 0.5 * step : 0.25) * now.squared)) {
      for_each_velocity([&](std::size_t k, std::size_t) { problem_->v(0)[k] = convex_v_[k]; });
      result.error = gradient(DeSaxceShift::frozen).error();
      break;
    }
    now = then;
    result.error = now.error();
  }
  return result;
}

void ImpulseSolver::move(double step) {
  for_each_velocity([&](std::size_t k, std::size_t) { problem_->v(0)[k] += step * dv_[k]; });
}

// u, p and D at v; rhs_ = M (v - v0) - J^T p.
ImpulseSolver::Gradient ImpulseSolver::gradient(DeSaxceShift shift) {
  zero_forces();
  double fastest = 0;
  coupling_blocks_.clear();
  for (const int i : island_->constraints) {
    const ImpulseConstraint& c = constraint(i);
    problem_->velocity(c, problem_->v(0), u_[i]);
    for (int r = 0; r < c.rows; ++r) u_[i][r] += c.b[r];
    if (c.law == ConstraintType::friction_disc && shift == DeSaxceShift::differentiated)
      project_disc(c, i);
    else
      project_impulse(c, multipliers_[i], shift, u_[i], p_[i], D_[i]);
    problem_->add_transpose(c, p_[i], f_.data());
    fastest = std::max({fastest, std::abs(u_[i][0]), std::abs(u_[i][1]), std::abs(u_[i][2])});
  }
  Gradient all = momentum_balance();
  all.noise = rho_ratio_ * rounding_error_;
  all.tolerance = std::max({0.01 * tolerance, 2e-14 * rho_ratio_ * fastest, all.noise});
  return all;
}

// Rounding error of the gradient for rho = rho0, as a velocity [m/s, rad/s]: p = l - rho u, and u
// is a sum that cancels (rolling contact), with rounding of its terms.
double ImpulseSolver::rounding_error() {
  zero_forces();
  const auto for_each_side = [&](const ImpulseConstraint& c, auto&& f) {
    for (int side = 0; side < 2; ++side)
      if (const int t = c.tree[side]; t != no_tree) f(problem_->J(c, side), problem_->size(t), t);
  };
  for (const int i : island_->constraints) {
    const ImpulseConstraint& c = constraint(i);
    Vec terms{std::abs(c.b[0]), std::abs(c.b[1]), std::abs(c.b[2])};
    for_each_side(c, [&](const double* J, int n, int t) {
      for (int r = 0; r < c.rows; ++r)
        for (int k = 0; k < n; ++k) terms[r] += std::abs(J[r * n + k] * problem_->v(t)[k]);
    });
    for_each_side(c, [&](const double* J, int n, int t) {
      for (int r = 0; r < c.rows; ++r)
        for (int k = 0; k < n; ++k)
          f_[problem_->first(t) + static_cast<std::size_t>(k)] +=
              rho0_[i] * terms[r] * std::abs(J[r * n + k]);
    });
  }
  double largest = 0;
  for (const int t : island_->trees)
    for (int k = 0; k < problem_->size(t); ++k)
      largest = std::max(largest, f_[problem_->first(t) + static_cast<std::size_t>(k)] /
                                      problem_->M(t)[k * problem_->size(t) + k]);
  return std::numeric_limits<double>::epsilon() * largest;
}

// Disc with the radius of the contact's p_n at this u, differentiated.
void ImpulseSolver::project_disc(const ImpulseConstraint& c, int i) {
  MultiplierState state = multipliers_[i];
  state.radius = c.radius * std::max(0.0, p_[c.of][0]);
  project_impulse(c, state, DeSaxceShift::differentiated, u_[i], p_[i], D_[i]);
  const Vec direction = sliding_direction(c, state, u_[i]);
  if (direction == Vec{}) return;
  CouplingBlock& block = coupling_blocks_.emplace_back(CouplingBlock{i, c.of, {}});
  for (int r = 0; r < c.rows; ++r)
    for (int k = 0; k < 3; ++k) block.D[3 * r + k] = c.radius * direction[r] * D_[c.of][k];
}

// rhs_ = M (v - v0) - f_
ImpulseSolver::Gradient ImpulseSolver::momentum_balance() {
  Gradient all;
  for (const int t : island_->trees) {
    const int n = problem_->size(t);
    const std::size_t at = problem_->first(t);
    const double* M = problem_->M(t);
    for (int k = 0; k < n; ++k)
      delta_[at + static_cast<std::size_t>(k)] = problem_->v(t)[k] - problem_->v0(t)[k];
    for (int r = 0; r < n; ++r) {
      double sum = -f_[at + static_cast<std::size_t>(r)];
      for (int k = 0; k < n; ++k) sum += M[r * n + k] * delta_[at + static_cast<std::size_t>(k)];
      rhs_[row_[t] + static_cast<std::size_t>(r)] = sum;
      all.largest = nan_max(all.largest, std::abs(sum) / M[r * n + r]);
      all.squared += sum * sum / M[r * n + r];
    }
  }
  return all;
}

// dv_ = -(M + J^T D J)^-1 rhs_
void ImpulseSolver::find_direction(bool symmetric) {
  assemble(symmetric);
  matrix_.factorise(symmetric);
  matrix_.solve(rhs_.data());
  for_each_velocity([&](std::size_t k, std::size_t row) { dv_[k] = -rhs_[row]; });
}

// M + J^T D J; if symmetric, the lower triangle only.
void ImpulseSolver::assemble(bool symmetric) {
  work_ += symmetric ? 0.5 * newton_work_ : newton_work_;
  if (!has_envelope_) set_envelope();
  matrix_.set_zero();
  for (const int t : island_->trees) {
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
  for (const int i : island_->constraints)
    add_products(constraint(i), constraint(i), D_[i], symmetric);
  if (!symmetric)
    for (const CouplingBlock& block : coupling_blocks_)
      add_products(constraint(block.of), constraint(block.by), block.D, symmetric);
}

// J_left^T D J_right, both sides of each.
void ImpulseSolver::add_products(const ImpulseConstraint& left, const ImpulseConstraint& right,
                                 const Mat& D, bool symmetric) {
  for (int side = 0; side < 2; ++side) {
    if (right.tree[side] == no_tree) continue;
    const int n = problem_->size(right.tree[side]);
    DJ_.resize(std::max(DJ_.size(), static_cast<std::size_t>(3 * n)));
    if (&left == &right)
      with_shape(left.rows, n, [&](auto rows, auto size) {
        product(D.data(), rows, problem_->J(right, side), rows, size, DJ_.data());
      });
    else
      product(D.data(), left.rows, problem_->J(right, side), right.rows, n, DJ_.data());
    for (int other = 0; other < 2; ++other)
      if (left.tree[other] != no_tree) add_block(left, other, right, side, symmetric);
  }
}

// J_s^T (D J)_t, s and t the trees of two sides; the upper triangle is column-major.
void ImpulseSolver::add_block(const ImpulseConstraint& left, int side_s,
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

// Line search: zero of the slope along dv, which is monotone (convex objective).
double ImpulseSolver::step_length() {
  double slope0 = 0, curvature = 0;  // of 1/2 |v - v0|_M^2
  for (const int t : island_->trees) {
    const int n = problem_->size(t);
    const double *dv = dv_.data() + problem_->first(t), *delta = delta_.data() + problem_->first(t);
    const double* M = problem_->M(t);
    for (int r = 0; r < n; ++r)
      for (int k = 0; k < n; ++k) {
        slope0 += dv[r] * M[r * n + k] * delta[k];
        curvature += dv[r] * M[r * n + k] * dv[k];
      }
  }
  double start = slope0;
  for (const int i : island_->constraints) {
    problem_->velocity(constraint(i), dv_.data(), du_[i]);
    start -= cone_dot(p_[i], du_[i]);
  }
  const auto slope = [&](double s) {
    double sum = slope0 + s * curvature;
    for (const int i : island_->constraints) {
      Vec u = u_[i];
      for (int r = 0; r < 3; ++r) u[r] += s * du_[i][r];
      sum -= cone_dot(project_impulse(constraint(i), multipliers_[i], u), du_[i]);
    }
    return sum;
  };
  double low = 0, high = 1, at_low = start, at_high = slope(1);
  if (!(at_high > 0.3 * std::abs(start))) return 1;
  double s = 1;
  for (int k = 0; k < 30; ++k) {  // regula falsi, Illinois variant
    s = (low * at_high - high * at_low) / (at_high - at_low);
    const double here = slope(s);
    if (std::abs(here) <= 0.1 * std::abs(start)) break;
    if (here > 0)
      high = s, at_high = here, at_low *= 0.5;
    else
      low = s, at_low = here, at_high *= 0.5;
  }
  return s;
}

}  // namespace twinarm
