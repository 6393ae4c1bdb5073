#include "solver/impulses/impulse_solver.h"

#include <algorithm>
#include <limits>

#include "solver/impulses/block_matrices.h"

namespace twinarm {
namespace {

constexpr int no_tree = ImpulseConstraint::no_tree;
// Penalty rho, relative to rho0.
constexpr double kFirstRho = 1e2, kLargeRho = 1e4, kDefaultMaxRho = 1e5, kMaxRho = 1e7, kMinRho = 1;
constexpr double kDivergence = 10;       // residual relative to the best one
constexpr std::size_t kSmallIsland = 8;  // constraints
constexpr int kRestartFactor = 4;        // times max_newton
constexpr int kMaxPaths = 8, kLargeNewton = 60;
// Sweeps before interior_point.cpp: so many, or the work of so many Newton steps.
constexpr double kFirstSweeps = 200, kSweepsPerNewton = 20;
// Newton steps that the budget must allow: to begin with them; for interior_point.cpp after sweeps.
constexpr double kAmple = 100, kInterior = 40;

}  // namespace

ImpulseReport ImpulseSolver::solve(ImpulseProblem& problem, bool full) {
  ImpulseReport report;
  problem_ = &problem;
  report.converged = factorise_trees();
  const std::size_t count = problem_->constraints().size();
  multipliers_.assign(count, {});
  rho0_.assign(count, 0);
  D_.resize(count), u_.resize(count), du_.resize(count), p_.resize(count);
  f_.assign(problem_->nv(), 0), dv_.resize(problem_->nv()), delta_.resize(problem_->nv());
  convex_v_.resize(problem_->nv());
  std::copy_n(problem_->v0(0), problem_->tree_count() > 0 ? problem_->nv() : 0, problem_->v(0));
  find_islands();
  for (std::size_t i = 0; i < count; ++i) {
    const ImpulseConstraint& c = problem_->constraints()[i];
    double inverse = 0;
    for (int side = 0; side < 2; ++side) {
      if (c.tree[side] == no_tree) continue;
      const int n = problem_->size(c.tree[side]);
      const double *J = problem_->J(c, side), *M = problem_->M(c.tree[side]);
      for (int k = 0; k < n; ++k) {
        double sum = 0;
        for (int r = 0; r < c.rows; ++r) sum += J[r * n + k] * J[r * n + k];
        inverse += sum / M[k * n + k];
      }
    }
    rho0_[i] = inverse > 0 ? c.rows / inverse : 1;
  }
  link_discs();
  solve_again_.resize(static_cast<std::size_t>(problem_->tree_count()));
  residual_.assign(solve_again_.size(), 0);
  for (std::size_t i = 0; i < island_count_; ++i) {
    island_ = &islands_[i];
    double residual = apply_impulses();
    char& again = solve_again_[static_cast<std::size_t>(island_->trees.front())];
    const bool fails = !(residual <= good_guess);
    bool open = fails || (again && residual > 0.1 * tolerance);
    if (!open && residual > tolerance) {
      residual = projected_gradient_step();
      open = !(residual <= good_guess);  // can increase the residual of shared contacts
    }
    if (open) {
      residual = solve_island(report, full);
      if (!has_budget() && !(residual <= accepted)) residual = scale_impulses();
      // Event-driven steps, with good_guess < tolerance, require the tolerance.
      const double required = good_guess < tolerance ? tolerance : accepted;
      const bool affords_newton = residual > tolerance && has_budget(3 * newton_work_);
      if (island_->constraints.size() <= kSmallIsland ||
          (affords_newton && (is_exact() || !(residual <= required))))
        residual = refine_solution(residual);
    }
    again = fails;
    for (const int t : island_->trees) residual_[static_cast<std::size_t>(t)] = residual;
    report.residual = nan_max(report.residual, residual);
    report.converged = report.converged && residual <= accepted;
  }
  return report;
}

bool ImpulseSolver::factorise_trees() {
  factors_.resize(problem_->blocks_size());
  bool positive = true;
  for (int t = 0; t < problem_->tree_count(); ++t)
    with_size(problem_->size(t), [&](auto n) {
      positive = cholesky(problem_->M(t), n, factors_.data() + problem_->block(t)) && positive;
    });
  return positive;
}

void ImpulseSolver::solve_tree(int tree, double* f) const {
  with_size(problem_->size(tree),
            [&](auto n) { solve_cholesky(factors_.data() + problem_->block(tree), n, f); });
}

void ImpulseSolver::zero_forces() {
  for (const int t : island_->trees)
    std::fill_n(f_.begin() + static_cast<std::ptrdiff_t>(problem_->first(t)), problem_->size(t),
                0.0);
}

// v = v0 + M^-1 J^T p and u = J v + b. Returns the residual of the laws.
double ImpulseSolver::apply_impulses() {
  zero_forces();
  for (const int i : island_->constraints)
    problem_->add_transpose(constraint(i), constraint(i).p, f_.data());
  for (const int t : island_->trees) {
    double* change = f_.data() + problem_->first(t);
    solve_tree(t, change);
    for (int k = 0; k < problem_->size(t); ++k) problem_->v(t)[k] = problem_->v0(t)[k] + change[k];
  }
  double residual = 0;
  for (const int i : island_->constraints) {
    ImpulseConstraint& c = constraint(i);
    problem_->velocity(c, problem_->v(0), c.u);
    for (int r = 0; r < c.rows; ++r) c.u[r] += c.b[r];
    if (c.law == ConstraintType::friction_disc)
      multipliers_[i].radius = c.radius * constraint(c.of).p[0];
    residual = nan_max(residual, law_residual(c, multipliers_[i], rho0_[i], c.u, c.p));
  }
  return residual;
}

// The same with impulses p.
double ImpulseSolver::apply_impulses(const std::vector<Vec>& p) {
  for (const int i : island_->constraints) constraint(i).p = p[i];
  return apply_impulses();
}

// One projected gradient step. Applied to accepted guesses, whose residual would otherwise
// accumulate over the steps of a body at rest.
double ImpulseSolver::projected_gradient_step() {
  constexpr double part = 0.125;  // rho / rho0: up to eight contacts share the inertia of a body
  for (const int i : island_->constraints) {
    ImpulseConstraint& c = constraint(i);
    update_multiplier(c, problem_->constraints(), c.u, c.p, multipliers_[i]);
    multipliers_[i].rho = part * rho0_[i];
    project_impulse(c, multipliers_[i], DeSaxceShift::frozen, c.u, p_[i], D_[i]);
    if (c.law != ConstraintType::compliant) {
      c.p = p_[i];
    } else {  // Newton step of the spring
      for (int r = 0; r < 3; ++r)
        c.p[r] += part * (p_[i][r] - c.p[r]) / (1 + D_[i][4 * r] / rho0_[i]);
    }
  }
  return apply_impulses();
}

void ImpulseSolver::keep_best(double residual) {
  if (!(residual < best_)) return;  // also if it is not a number
  best_ = residual;
  for (const int i : island_->constraints) best_p_[i] = constraint(i).p;
}

void ImpulseSolver::iterate(int max_steps, double rho, ImpulseReport& report) {
  rho_ratio_ = rho;
  run_augmented_lagrangian(max_steps, report);
  keep_best(apply_impulses());
}

// The stages of impulse_solver.h until the residual is accepted. Sets the best p and returns its
// residual.
double ImpulseSolver::solve_island(ImpulseReport& report, bool full) {
  ++report.solved;
  order();
  best_ = std::numeric_limits<double>::infinity();
  for (std::vector<Vec>* p : {&best_p_, &iterate_p_, &guess_p_, &swept_p_})
    p->resize(problem_->constraints().size());
  const bool small = island_->constraints.size() <= kSmallIsland;
  for (const int i : island_->constraints) best_p_[i] = guess_p_[i] = constraint(i).p;
  if (small && has_warm_start()) {
    keep_best(warm_start_newton(report));
    if (best_ <= accepted) return best_;
    apply_impulses(guess_p_);
  }
  if (small || (is_exact() && has_budget(kAmple * newton_work_))) {
    iterate(small ? quick_newton_small : quick_newton, kFirstRho, report);
  } else {
    const bool interior_follows = has_budget(kInterior * newton_work_);
    const double first = std::max(kFirstSweeps, kSweepsPerNewton * newton_work_ / sweep_work_);
    run_sweeps(interior_follows ? first : std::numeric_limits<double>::infinity(), report);
    if (!interior_follows) return apply_impulses(best_p_);
  }
  if (best_ <= accepted) return best_;
  report.interior = std::max(report.interior, interior_point_start());
  keep_best(apply_impulses());
  if (best_ > accepted) iterate(small ? max_newton : kLargeNewton, kFirstRho, report);
  if (full && best_ > accepted) try_other_starts(report);
  if (best_ > accepted) {  // no solution found, or none there (Painleve): a small residual
    keep_best(apply_impulses(guess_p_)), apply_impulses(best_p_);
    run_sweeps(kFirstSweeps, report);
  }
  return apply_impulses(best_p_);
}

void ImpulseSolver::try_other_starts(ImpulseReport& report) {
  const auto goes_on = [&] { return best_ > accepted && has_budget(); };
  const bool small = island_->constraints.size() <= kSmallIsland;
  const auto from_path = [&](int start, int max_steps) {
    report.path = std::max(report.path, follow_path(start));
    keep_best(apply_impulses());
    if (best_ > accepted) iterate(max_steps, kFirstRho, report);
  };
  if (!small) from_path(0, kLargeNewton);
  // A body between two surfaces may slide, or jam with unbounded impulses. The interior-point start
  // leads to jamming even if a small gap excludes it: also iterate from the guess.
  for (const double rho : {kFirstRho, kLargeRho}) {
    if (!goes_on()) break;
    apply_impulses(guess_p_);
    iterate(max_newton, rho, report);
  }
  for (int start = small ? 0 : 1; start < kMaxPaths && goes_on(); ++start)
    from_path(start, max_newton);
  // Restarts from the best p while the residual decreases.
  for (double before = 0; goes_on() && (before == 0 || best_ < 0.5 * before);) {
    before = best_;
    apply_impulses(best_p_);
    iterate(kRestartFactor * max_newton, kFirstRho, report);
  }
}

void ImpulseSolver::update_multipliers() {
  for (const int i : island_->constraints) {
    const ImpulseConstraint& c = constraint(i);
    update_multiplier(c, problem_->constraints(), c.u, c.p, multipliers_[i]);
  }
}

// From p and u of the constraints, v and rho_ratio_. If the residual grows, restart from the best
// iterate with a smaller rho, which keeps the inner solutions closer to the start.
void ImpulseSolver::run_augmented_lagrangian(int max_steps, ImpulseReport& report) {
  int newton = 0;
  double last = 0, best = std::numeric_limits<double>::infinity();
  double max_rho = kDefaultMaxRho;
  for (const int i : island_->constraints) iterate_p_[i] = constraint(i).p;
  update_multipliers();
  // For many bodies the bound is larger than their final errors and would end iterations too early.
  rounding_error_ = island_->constraints.size() <= kSmallIsland ? rounding_error() : 0;
  while (newton < max_steps && has_budget()) {
    for (const int i : island_->constraints) multipliers_[i].rho = rho_ratio_ * rho0_[i];
    const InnerResult inner = solve_inner_problem(max_steps - newton);
    newton += std::max(1, inner.steps);
    double residual = inner.error;
    for (const int i : island_->constraints) {
      ImpulseConstraint& c = constraint(i);
      c.p = p_[i], c.u = u_[i];
      update_multiplier(c, problem_->constraints(), c.u, c.p, multipliers_[i]);
      residual = nan_max(residual, law_residual(c, multipliers_[i], rho0_[i], c.u, c.p));
    }
    report.newton = std::max(report.newton, newton);
    if (residual <= 0.3 * tolerance) return;
    if (residual < best) {
      best = residual;
      for (const int i : island_->constraints) iterate_p_[i] = constraint(i).p;
    } else if (!(residual <= kDivergence * best) && rho_ratio_ > kMinRho) {
      apply_impulses(iterate_p_);
      update_multipliers();
      max_rho = rho_ratio_ = std::max(kMinRho, 0.01 * rho_ratio_);
      last = best;
      continue;
    }
    // Slow convergence of the multipliers with a constant active set requires a larger rho.
    const bool slow = inner.steps <= 2 && residual > 0.3 * last;
    if (rho_ratio_ < max_rho || (slow && rho_ratio_ < kMaxRho)) rho_ratio_ *= 10;
    last = residual;
  }
  if (!(last <= best)) apply_impulses(iterate_p_);
}

}  // namespace twinarm
