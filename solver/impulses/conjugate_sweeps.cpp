#include "solver/impulses/conjugate_sweeps.h"

#include <algorithm>
#include <cmath>

#include "solver/impulses/block_matrices.h"
#include "solver/linear_algebra/second_order_cone.h"

namespace twinarm {
namespace {

constexpr double kRegularisation = 1e-12;    // of W, relative to its trace: redundant rows
constexpr std::size_t kMaxOpenBatches = 32;  // that are looked at for a free lane

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
  const std::size_t count = problem.constraints().size(), nv = problem.nv();
  local_.resize(count), change_.resize(count), direction_.resize(count);
  last_v_.resize(nv), v_direction_.resize(nv), v_.assign(nv + 6, 0.0);
  Y_.resize(problem.jacobian_size());
  batches_.clear(), others_.clear(), first_open_ = 0;
  for (const int i : island.constraints()) {
    const ImpulseConstraint& c = island.constraint(i);
    bool batched =
        c.law == ConstraintType::coulomb_cone && island.next_disc[i] < 0 && c.tree[0] != c.tree[1];
    for (int side = 0; side < 2; ++side) {
      const int tree = c.tree[side];
      if (tree == ImpulseConstraint::no_tree) continue;
      const int n = problem.size(tree);
      std::copy_n(problem.J(c, side), c.rows * n, Y_.data() + c.J[side]);
      for (int r = 0; r < c.rows; ++r) island.solve_tree(tree, Y_.data() + c.J[side] + r * n);
      batched = batched && n == 6;
    }
    set_local(c, i);
    change_[i] = direction_[i] = {};
    batched ? add_to_batch(c, i) : others_.push_back(i);
  }
  island.for_each_velocity(
      [&](std::size_t k) { v_[k] = last_v_[k] = problem.v(0)[k], v_direction_[k] = 0; });
  squared_ = last_squared_ = 0;
}

void ConjugateSweeps::set_local(const ImpulseConstraint& c, int i) {
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

// Whether a lane is free, and no other has one of these bodies.
bool ConjugateSweeps::fits(const ImpulseConstraint& c, const ConeBatch& batch) const {
  if (batch.constraint.back() >= 0) return false;
  for (const int i : batch.constraint) {
    if (i < 0) break;
    for (const int tree : island_->constraint(i).tree)
      if (tree != ImpulseConstraint::no_tree && (tree == c.tree[0] || tree == c.tree[1]))
        return false;
  }
  return true;
}

// The lanes are filled in sequence.
void ConjugateSweeps::add_to_batch(const ImpulseConstraint& c, int i) {
  std::size_t at = first_open_;
  while (at < batches_.size() && !fits(c, batches_[at])) ++at;
  if (at == batches_.size()) {
    ConeBatch& batch = batches_.emplace_back();
    batch.constraint.fill(-1);
    batch.local.W[0] = batch.local.S[0] = batch.local.S[2] = 1;  // of the lanes that stay free
    for (auto& side : batch.first) side.fill(static_cast<int>(problem_->nv()));
    if (at - first_open_ >= kMaxOpenBatches) ++first_open_;
  }
  ConeBatch& batch = batches_[at];
  const auto lane =
      static_cast<int>(std::ranges::find(batch.constraint, -1) - batch.constraint.begin());
  batch.constraint[lane] = i;
  const auto copy = [lane](const double* from, auto& to) {
    for (std::size_t k = 0; k < to.size(); ++k) to[k].set(lane, from[k]);
  };
  for (int side = 0; side < 2; ++side) {
    if (c.tree[side] == ImpulseConstraint::no_tree) continue;
    batch.first[side][lane] = static_cast<int>(problem_->first(c.tree[side]));
    copy(problem_->J(c, side), batch.J[side]);
    copy(Y_.data() + c.J[side], batch.Y[side]);
  }
  const Local& local = local_[i];
  copy(local.W.data(), batch.local.W), copy(local.inverse.data(), batch.local.inverse);
  copy(local.S.data(), batch.local.S), copy(local.w.data(), batch.local.w);
  copy(c.b.data(), batch.b), copy(c.p.data(), batch.p);
  batch.mu.set(lane, c.mu), batch.inverse_rho.set(lane, 1 / island_->rho0[i]);
}

void ConjugateSweeps::write_impulses() {
  for (const ConeBatch& batch : batches_)
    for (int lane = 0; lane < ConeBatch::kLanes; ++lane)
      if (const int i = batch.constraint[lane]; i >= 0)
        for (int r = 0; r < 3; ++r) island_->constraint(i).p[r] = batch.p[r][lane];
}

// With a step along the conjugate direction (Fletcher and Reeves); restart while the changes
// increase.
double ConjugateSweeps::sweep() {
  const double beta = last_squared_ > 0 && squared_ <= last_squared_ ? squared_ / last_squared_ : 0;
  extrapolate(beta);
  auto [squared, largest] = sweep_cones(batches_, beta, v_.data());
  for (const int i : others_) {
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
          add_transposed_product(Y_.data() + c.J[side], rows, n, change.data(),
                                 v_.data() + problem_->first(t));
        });
    squared += here / island_->rho0[i];
    largest = std::max(largest, here / (island_->rho0[i] * island_->rho0[i]));
  }
  squared_ = squared;
  return std::sqrt(largest);
}

void ConjugateSweeps::extrapolate(double beta) {
  last_squared_ = squared_;
  for (const int i : others_) {
    Vec &direction = direction_[i], &p = island_->constraint(i).p;
    for (int r = 0; r < 3; ++r) {
      p[r] += beta * direction[r];
      direction[r] = beta > 0 ? beta * direction[r] + change_[i][r] : 0;
    }
  }
  island_->for_each_velocity([&](std::size_t k) {
    const double change = v_[k] - last_v_[k];
    v_[k] += beta * v_direction_[k];
    v_direction_[k] = beta > 0 ? beta * v_direction_[k] + change : 0;
    last_v_[k] = v_[k];
  });
}

// Impulse of this constraint at the velocities of the others' impulses.
Vec ConjugateSweeps::solve_constraint(const ImpulseConstraint& c, int i) {
  Local& local = local_[i];
  Vec u;
  problem_->velocity(c, v_.data(), u);
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
  return c.law == ConstraintType::coulomb_cone ? solve_cone(c.mu, u, local)
                                               : solve_disc(c, local, u);
}

// q: velocity without this impulse.
Vec ConjugateSweeps::solve_disc(const ImpulseConstraint& c, Local& local, const Vec& q) {
  const double radius = c.radius * std::max(0.0, island_->constraint(c.of).p[0]);
  if (radius == 0) return {};
  const Vec p = sticking_impulse(local, q);
  if (p[0] * p[0] + p[1] * p[1] <= radius * radius) return p;
  const Vec slides = slide(1.0, radius, {q[0], c.rows > 1 ? q[1] : 0}, local);
  return {slides[1], slides[2], 0};
}

}  // namespace twinarm
