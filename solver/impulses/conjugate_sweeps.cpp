#include "solver/impulses/conjugate_sweeps.h"

#include "solver/linear_algebra/block_matrices.h"
#include "solver/linear_algebra/second_order_cone.h"

namespace twinarm {
namespace {

constexpr double kRegularisation = 1e-12;  // of W, relative to its trace: redundant rows
constexpr double kImmovable = 1e200;       // W of a constraint that moves nothing
constexpr std::size_t kOpenBatches = 32;   // that are looked at for a free lane

}  // namespace

void ConjugateSweeps::start(ImpulseIsland& island) {
  island_ = &island;
  ImpulseProblem& problem = *(problem_ = island.problem);
  const std::size_t count = problem.constraints().size(), nv = problem.nv();
  local_.resize(count), change_.resize(count), direction_.resize(count);
  last_v_.resize(nv), v_direction_.resize(nv), v_.resize(nv + 6);
  Y_.resize(problem.jacobian_size());
  batches_.clear(), others_.clear(), std::fill_n(v_.data() + nv, 6, 0.0);
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
  LocalProblem<double>& local = local_[i];
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
  const double trace = W[0] + W[4] + W[8];
  for (int r = 0; r < 3; ++r) W[4 * r] += trace > 0 ? kRegularisation * trace : kImmovable;
  if (c.law == ConstraintType::friction_disc)  // no normal row
    local.S = {W[0], W[1], W[4]};
  else
    local.w = {W[1] / W[0], W[2] / W[0]},
    local.S = {W[4] - W[1] * local.w[0], W[5] - W[2] * local.w[0], W[8] - W[2] * local.w[1]};
  const auto& [aa, ab, bb] = local.S;
  const double det = aa * bb - ab * ab;
  local.inverse = {1 / W[0], bb / det, -ab / det, aa / det};
}

// Whether a lane is free, and no other has one of these bodies.
bool ConjugateSweeps::fits(const ImpulseConstraint& c, const ConeBatch& batch) const {
  if (batch.constraint.back() >= 0) return false;
  return std::ranges::none_of(batch.constraint, [&](int i) {
    return i >= 0 && std::ranges::any_of(island_->constraint(i).tree, [&](int tree) {
             return tree != ImpulseConstraint::no_tree && (tree == c.tree[0] || tree == c.tree[1]);
           });
  });
}

void ConjugateSweeps::add_to_batch(const ImpulseConstraint& c, int i) {
  std::size_t at = batches_.size() - std::min(batches_.size(), kOpenBatches);
  while (at < batches_.size() && !fits(c, batches_[at])) ++at;
  if (at == batches_.size()) {
    ConeBatch& batch = batches_.emplace_back();
    batch.constraint.fill(-1);
    for (auto& side : batch.first) side.fill(static_cast<int>(problem_->nv()));
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
  const LocalProblem<double>& local = local_[i];
  copy(local.W.data(), batch.local.W), copy(local.S.data(), batch.local.S);
  copy(local.w.data(), batch.local.w), copy(local.inverse.data(), batch.local.inverse);
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
  last_squared_ = squared_;
  island_->for_each_velocity([&](std::size_t k) {
    const double change = v_[k] - last_v_[k];
    v_[k] += beta * v_direction_[k];
    v_direction_[k] = beta > 0 ? beta * v_direction_[k] + change : 0;
    last_v_[k] = v_[k];
  });
  auto [squared, largest] = sweep_cones(batches_, beta, v_.data());
  for (const int i : others_) {
    ImpulseConstraint& c = island_->constraint(i);
    Vec &direction = direction_[i], &change = change_[i];
    for (int r = 0; r < 3; ++r) {
      c.p[r] += beta * direction[r];
      direction[r] = beta > 0 ? beta * direction[r] + change[r] : 0;
    }
    const Vec p = solve_constraint(c, i);
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

// Impulse of this constraint at the velocities of the others' impulses.
Vec ConjugateSweeps::solve_constraint(const ImpulseConstraint& c, int i) {
  LocalProblem<double>& local = local_[i];
  Vec u;
  problem_->velocity(c, v_.data(), u);
  for (int r = 0; r < c.rows; ++r) u[r] += c.b[r];
  Vec p = c.p;
  switch (c.law) {
    case ConstraintType::bilateral: {
      const Vec step = local.stick(u);
      for (int r = 0; r < c.rows; ++r) p[r] += step[r];
      return p;
    }
    case ConstraintType::unilateral:
      return {std::max(0.0, p[0] - u[0] * local.inverse[0]), 0, 0};
    case ConstraintType::box:
      return {std::clamp(p[0] - u[0] * local.inverse[0], c.low, c.high), 0, 0};
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
  if (c.law == ConstraintType::coulomb_cone) return solve_cone(c.mu, u, local);
  const double radius = c.radius * std::max(0.0, island_->constraint(c.of).p[0]);
  if (radius == 0) return {};
  const auto [x, y] = local.stick(u[0], u[1]);
  if (x * x + y * y <= radius * radius) return {x, y, 0};
  const Vec slides = slide(1.0, radius, {u[0], u[1]}, 1.0, local);
  return {slides[1], slides[2], 0};
}

}  // namespace twinarm
