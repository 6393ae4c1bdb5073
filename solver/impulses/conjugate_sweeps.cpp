#include "solver/impulses/conjugate_sweeps.h"

#include <algorithm>
#include <cmath>

#include "solver/impulses/block_matrices.h"
#include "solver/linear_algebra/second_order_cone.h"

namespace twinarm {
namespace {

constexpr double kRegularisation = 1e-12;  // of W, relative to its trace: redundant rows
constexpr int kMaxSlidingSteps = 12;

// Inverse of the leading rows x rows block of a symmetric matrix, made positive definite.
Mat inverse_of(const Mat& W, int rows) {
  std::array<double, 9> A{}, L{};
  double trace = 0;
  for (int r = 0; r < rows; ++r) trace += W[4 * r];
  for (int r = 0; r < rows; ++r)
    for (int k = 0; k < rows; ++k)
      A[r * rows + k] = W[3 * r + k] + (r == k ? kRegularisation * trace : 0);
  Mat out{};
  if (!(trace > 0) || !cholesky(A.data(), rows, L.data())) return out;
  for (int k = 0; k < rows; ++k) {
    Vec column{};
    column[k] = 1;
    solve_cholesky(L.data(), rows, column.data());
    for (int r = 0; r < rows; ++r) out[3 * r + k] = column[r];
  }
  return out;
}

}  // namespace

void ConjugateSweeps::start(ImpulseIsland& island) {
  island_ = &island;
  ImpulseProblem& problem = *(problem_ = island.problem);
  const std::vector<ImpulseConstraint>& all = problem.constraints();
  local_.resize(all.size()), change_.resize(all.size()), direction_.resize(all.size());
  v_.resize(problem.nv()), v_direction_.resize(problem.nv());
  Y_.resize(problem.jacobian_size());
  for (const int i : island.constraints()) {
    ImpulseConstraint& c = island.constraint(i);
    for (int side = 0; side < 2; ++side) {
      if (c.tree[side] == ImpulseConstraint::no_tree) continue;
      const int tree = c.tree[side];
      std::copy_n(problem.J(c, side), c.rows * problem.size(tree), Y_.data() + c.J[side]);
      for (int r = 0; r < c.rows; ++r)
        island.solve_tree(tree, Y_.data() + c.J[side] + r * problem.size(tree));
    }
    set_local(c, i);
    change_[i] = direction_[i] = {};
  }
  island_->for_each_velocity([&](std::size_t k) { v_[k] = problem.v(0)[k], v_direction_[k] = 0; });
  squared_ = last_squared_ = 0;
}

void ConjugateSweeps::set_local(ImpulseConstraint& c, int i) {
  Local& local = local_[i];
  local = {};
  Mat& W = local.W;
  for (int side = 0; side < 2; ++side) {
    if (c.tree[side] == ImpulseConstraint::no_tree) continue;
    const int n = problem_->size(c.tree[side]);
    const double *J = problem_->J(c, side), *Y = Y_.data() + c.J[side];
    for (int r = 0; r < c.rows; ++r)
      for (int s = 0; s < c.rows; ++s)
        for (int k = 0; k < n; ++k) W[3 * r + s] += J[r * n + k] * Y[s * n + k];
  }
  local.inverse = inverse_of(W, c.rows);
  if (c.law == ConstraintType::coulomb_cone) {
    local.w = {W[1] / W[0], W[2] / W[0]};
    local.S = {W[4] - W[1] * local.w[0], W[5] - W[2] * local.w[0], W[8] - W[2] * local.w[1]};
  } else {
    local.S = {W[0], W[1], c.rows > 1 ? W[4] : 1};
  }
}

double ConjugateSweeps::sweep() {
  extrapolate();
  double largest = 0;
  squared_ = 0;
  for (const int i : island_->constraints()) {
    ImpulseConstraint& c = island_->constraint(i);
    const Vec p = solve_constraint(c, i);
    Vec& change = change_[i];
    double here = 0;
    for (int r = 0; r < 3; ++r) change[r] = p[r] - c.p[r], here += change[r] * change[r];
    c.p = p;
    if (here == 0) continue;
    for (int side = 0; side < 2; ++side)
      if (const int t = c.tree[side]; t != ImpulseConstraint::no_tree)
        with_shape(c.rows, problem_->size(t), [&](auto rows, auto n) {
          add_transposed_product(Y_.data() + c.J[side], rows, n, change.data(), problem_->v(t));
        });
    squared_ += here / island_->rho0[i];
    largest = std::max(largest, here / (island_->rho0[i] * island_->rho0[i]));
  }
  return std::sqrt(largest);
}

// Step along the conjugate direction (Fletcher and Reeves); restart while the changes increase.
void ConjugateSweeps::extrapolate() {
  const double beta = last_squared_ > 0 && squared_ <= last_squared_ ? squared_ / last_squared_ : 0;
  last_squared_ = squared_;
  for (const int i : island_->constraints()) {
    Vec &direction = direction_[i], &p = island_->constraint(i).p;
    for (int r = 0; r < 3; ++r) {
      p[r] += beta * direction[r];
      direction[r] = beta > 0 ? beta * direction[r] + change_[i][r] : 0;
    }
  }
  double* v = problem_->v(0);
  island_->for_each_velocity([&](std::size_t k) {
    const double change = v[k] - v_[k];
    v[k] += beta * v_direction_[k];
    v_direction_[k] = beta > 0 ? beta * v_direction_[k] + change : 0;
    v_[k] = v[k];
  });
}

// Impulse of this constraint at the velocities of the others' impulses.
Vec ConjugateSweeps::solve_constraint(const ImpulseConstraint& c, int i) {
  Local& local = local_[i];
  Vec u;
  problem_->velocity(c, problem_->v(0), u);
  for (int r = 0; r < c.rows; ++r) u[r] += c.b[r];
  Vec p = c.p;
  switch (c.law) {
    case ConstraintType::bilateral: {
      const Vec step = times(local.inverse, u);
      for (int r = 0; r < c.rows; ++r) p[r] -= step[r];
      return p;
    }
    case ConstraintType::unilateral:
      return {std::max(0.0, p[0] - local.inverse[0] * u[0]), 0, 0};
    case ConstraintType::box:
      return {std::clamp(p[0] - local.inverse[0] * u[0], c.low, c.high), 0, 0};
    case ConstraintType::compliant: {  // Newton step of each spring
      MultiplierState state;
      state.radius = c.mu * p[0];
      Vec next;
      Mat D;
      project_impulse(c, state, DeSaxceShift::frozen, u, next, D);
      for (int r = 0; r < 3; ++r) p[r] += (next[r] - p[r]) / (1 + D[4 * r] * local.W[4 * r]);
      return p;
    }
    case ConstraintType::coulomb_cone:
    case ConstraintType::friction_disc:
      break;
  }
  const Vec own = times(local.W, p);
  for (int r = 0; r < 3; ++r) u[r] -= own[r];
  return c.law == ConstraintType::coulomb_cone ? solve_cone(c, local, u) : solve_disc(c, local, u);
}

// q: velocity without this impulse.
Vec ConjugateSweeps::solve_cone(const ImpulseConstraint& c, Local& local, const Vec& q) {
  if (q[0] >= 0) return {};
  Vec p = times(local.inverse, q);
  for (double& x : p) x = -x;
  if (p[0] >= 0 && p[1] * p[1] + p[2] * p[2] <= c.mu * c.mu * p[0] * p[0]) return p;
  const double a = -q[0] / local.W[0];
  const auto t = slide({c.mu, a, {q[1] + local.W[1] * a, q[2] + local.W[2] * a}}, local);
  const double p_n = std::max(0.0, a - local.w[0] * t[0] - local.w[1] * t[1]);
  const double norm = std::sqrt(t[0] * t[0] + t[1] * t[1]);
  const double scale = norm > 0 ? c.mu * p_n / norm : 0;
  return {p_n, scale * t[0], scale * t[1]};
}

Vec ConjugateSweeps::solve_disc(const ImpulseConstraint& c, Local& local, const Vec& q) {
  const double radius = c.radius * std::max(0.0, island_->constraint(c.of).p[0]);
  if (radius == 0) return {};
  Vec p = times(local.inverse, q);
  for (double& x : p) x = -x;
  if (p[0] * p[0] + p[1] * p[1] <= radius * radius) return p;
  const auto t = slide({1, radius, {q[0], c.rows > 1 ? q[1] : 0}}, local);
  const double norm = std::sqrt(t[0] * t[0] + t[1] * t[1]);
  return {radius * t[0] / norm, radius * t[1] / norm, 0};
}

// Newton's method on mu p_n / |p_t| = 1, which is linear in lambda for S = s 1, w = 0; bracketed.
std::array<double, 2> ConjugateSweeps::slide(const Sliding& problem, Local& local) {
  const double aa = local.S[0], ab = local.S[1], bb = local.S[2];
  const auto solve = [&](double lambda, const std::array<double, 2>& right) {
    const double x = aa + lambda, y = bb + lambda, det = x * y - ab * ab;
    return std::array{(y * right[0] - ab * right[1]) / det, (x * right[1] - ab * right[0]) / det};
  };
  double low = 0, high = INFINITY, lambda = local.lambda;
  std::array<double, 2> t{};
  for (int k = 0; k < kMaxSlidingSteps; ++k) {
    t = solve(lambda, {-problem.g[0], -problem.g[1]});
    const auto slope = solve(lambda, {-t[0], -t[1]});
    const double norm2 = t[0] * t[0] + t[1] * t[1], norm = std::sqrt(norm2);
    const double p_n = problem.a - local.w[0] * t[0] - local.w[1] * t[1];
    const double error = problem.mu * p_n / norm - 1;
    if (std::abs(error) < 1e-12 || !(norm > 0)) break;
    (error < 0 ? low : high) = lambda;
    const double change = problem.mu / norm *
                          (-local.w[0] * slope[0] - local.w[1] * slope[1] -
                           p_n * (t[0] * slope[0] + t[1] * slope[1]) / norm2);
    const double newton = lambda - error / change;
    if (newton > low && newton < high)
      lambda = newton;
    else
      lambda = high < INFINITY ? 0.5 * (low + high) : 2 * lambda + aa + bb;
  }
  local.lambda = lambda;
  return t;
}

}  // namespace twinarm
