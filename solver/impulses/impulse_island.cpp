#include "solver/impulses/impulse_island.h"

#include <limits>

#include "solver/linear_algebra/block_matrices.h"
#include "solver/linear_algebra/second_order_cone.h"

namespace twinarm {

void ImpulseReport::add(const ImpulseReport& other) {
  solved += other.solved;
  sweeps = std::max(sweeps, other.sweeps), newton = std::max(newton, other.newton);
  interior = std::max(interior, other.interior), path = std::max(path, other.path);
  residual = nan_max(residual, other.residual);
  converged = converged && other.converged;
}

bool ImpulseIsland::set(ImpulseProblem& in_problem, const Members& members,
                        const ImpulseAccuracy& accuracy) {
  problem = &in_problem, members_ = &members, wanted = accuracy;
  const std::size_t count = problem->constraints().size();
  multipliers.resize(count), rho0.resize(count), next_disc.resize(count), D.resize(count);
  for (std::vector<Vec>* list : {&best_p, &p, &u, &du}) list->resize(count);
  for (std::vector<double>* list : {&forces, &balance, &dv, &change_}) list->resize(problem->nv());
  factors.resize(problem->blocks_size());
  factored_.resize(factors.size(), std::numeric_limits<double>::quiet_NaN());
  best = std::numeric_limits<double>::infinity();
  work = sweep_work = 0;
  bool positive = true;
  for (const int t : trees())
    with_size(problem->size(t), [&](auto n) {
      const double* M = problem->M(t);
      double* known = factored_.data() + problem->block(t);
      if (std::equal(M, M + n * n, known)) return;  // bodies at rest
      std::copy_n(M, n * n, known);
      if (cholesky(M, n, factors.data() + problem->block(t))) return;
      positive = false;
      known[0] = std::numeric_limits<double>::quiet_NaN();
    });
  for (const int i : constraints()) {
    const ImpulseConstraint& c = constraint(i);
    multipliers[i] = {}, next_disc[i] = -1;
    const double inverse = inverse_inertia(c);
    rho0[i] = inverse > 0 ? c.rows / inverse : 1;
    double n = 0;  // velocities
    for (const int t : c.tree) n += t == ImpulseConstraint::no_tree ? 0 : problem->size(t);
    sweep_work += 100 + 4 * c.rows * n;
  }
  for (std::size_t k = constraints().size(); k-- > 0;) {
    const int i = constraints()[k];
    const ImpulseConstraint& c = constraint(i);
    if (c.law != ConstraintType::friction_disc || !(c.radius > 0)) continue;
    next_disc[i] = next_disc[c.of], next_disc[c.of] = i;
  }
  return positive;
}

// Trace of J diag(M)^-1 J^T.
double ImpulseIsland::inverse_inertia(const ImpulseConstraint& c) const {
  double inverse = 0;
  for (int side = 0; side < 2; ++side) {
    if (c.tree[side] == ImpulseConstraint::no_tree) continue;
    const int n = problem->size(c.tree[side]);
    const double *J = problem->J(c, side), *M = problem->M(c.tree[side]);
    for (int k = 0; k < n; ++k) {
      double sum = 0;
      for (int r = 0; r < c.rows; ++r) sum += J[r * n + k] * J[r * n + k];
      inverse += sum / M[k * n + k];
    }
  }
  return inverse;
}

void ImpulseIsland::solve_tree(int tree, double* rhs) const {
  with_size(problem->size(tree),
            [&](auto n) { solve_cholesky(factors.data() + problem->block(tree), n, rhs); });
}

void ImpulseIsland::zero_forces() {
  for_each_velocity([&](std::size_t k) { forces[k] = 0; });
}

double ImpulseIsland::apply_impulses() {
  zero_forces();
  for (const int i : constraints())
    problem->add_transpose(constraint(i), constraint(i).p, forces.data());
  for (const int t : trees()) {
    double* change = forces.data() + problem->first(t);
    solve_tree(t, change);
    for (int k = 0; k < problem->size(t); ++k) problem->v(t)[k] = problem->v0(t)[k] + change[k];
  }
  double residual = 0;
  for (const int i : constraints()) {
    ImpulseConstraint& c = constraint(i);
    problem->velocity(c, problem->v(0), c.u);
    for (int r = 0; r < c.rows; ++r) c.u[r] += c.b[r];
    if (c.law == ConstraintType::friction_disc)
      multipliers[i].radius = c.radius * constraint(c.of).p[0];
    residual = nan_max(residual, law_residual(c, multipliers[i], rho0[i], c.u, c.p));
  }
  return residual;
}

double ImpulseIsland::apply_impulses(const std::vector<Vec>& impulses) {
  for (const int i : constraints()) constraint(i).p = impulses[i];
  return apply_impulses();
}

double ImpulseIsland::projected_gradient_step() {
  constexpr double part = 0.125;  // rho / rho0: up to eight contacts share the inertia of a body
  for (const int i : constraints()) {
    ImpulseConstraint& c = constraint(i);
    update_multiplier(c, problem->constraints(), c.u, c.p, multipliers[i]);
    multipliers[i].rho = part * rho0[i];
    project_impulse(c, multipliers[i], DeSaxceShift::frozen, c.u, p[i], D[i]);
    if (c.law != ConstraintType::compliant) {
      c.p = p[i];
    } else {  // Newton step of the spring
      for (int r = 0; r < 3; ++r) c.p[r] += part * (p[i][r] - c.p[r]) / (1 + D[i][4 * r] / rho0[i]);
    }
  }
  return apply_impulses();
}

// p . J v0 + 1/2 p . J M^-1 J^T p <= 0, as of exact solutions unless a support moves.
double ImpulseIsland::scale_impulses() {
  double linear = 0, quadratic = 0;
  for (const int i : constraints()) {
    const ImpulseConstraint& c = constraint(i);
    if (c.b[0] < 0 || c.b[1] != 0 || c.b[2] != 0) return apply_impulses();
    for (int r = 0; r < c.rows; ++r) quadratic += c.p[r] * (c.u[r] - c.b[r]);
    Vec u0;
    problem->velocity(c, problem->v0(0), u0);
    linear += cone_dot(c.p, u0);
  }
  quadratic -= linear;  // p . J (v - v0)
  if (!(linear + 0.5 * quadratic > 0)) return apply_impulses();
  const double scale = std::max(0.0, -2 * linear / quadratic);
  for (const int i : constraints())
    for (double& impulse : constraint(i).p) impulse *= scale;
  return apply_impulses();
}

void ImpulseIsland::keep_best(double residual) {
  if (!(residual < best)) return;  // also if it is not a number
  best = residual;
  for (const int i : constraints()) best_p[i] = constraint(i).p;
}

void ImpulseIsland::update_multipliers() {
  for (const int i : constraints()) {
    const ImpulseConstraint& c = constraint(i);
    update_multiplier(c, problem->constraints(), c.u, c.p, multipliers[i]);
  }
}

ImpulseIsland::Imbalance ImpulseIsland::momentum_balance() {
  Imbalance all;
  for (const int t : trees()) {
    const int n = problem->size(t);
    const std::size_t at = problem->first(t);
    const double* M = problem->M(t);
    for (int k = 0; k < n; ++k)
      change_[at + static_cast<std::size_t>(k)] = problem->v(t)[k] - problem->v0(t)[k];
    for (int r = 0; r < n; ++r) {
      double sum = -forces[at + static_cast<std::size_t>(r)];
      for (int k = 0; k < n; ++k) sum += M[r * n + k] * change_[at + static_cast<std::size_t>(k)];
      balance[at + static_cast<std::size_t>(r)] = sum;
      all.largest = nan_max(all.largest, std::abs(sum) / M[r * n + r]);
      all.squared += sum * sum / M[r * n + r];
    }
  }
  return all;
}

void ImpulseIsland::move(double step) {
  for_each_velocity([&](std::size_t k) { problem->v(0)[k] += step * dv[k]; });
}

}  // namespace twinarm
