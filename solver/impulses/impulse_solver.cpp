#include "solver/impulses/impulse_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/impulses/block_matrices.h"

namespace twinarm {
namespace {

constexpr int no_tree = ImpulseConstraint::no_tree;
constexpr double first_rho = 1e2, large_rho = 1e4, usual_rho = 1e5,
                 max_rho = 1e7;                // times rho0
constexpr double min_rho = 1, astray = 10;     // a residual so much larger than the best
constexpr int max_returns = 10, patience = 4;  // times max_newton, from the best of all
constexpr std::size_t few = 8;  // constraints of an island whose solution is polished
constexpr int max_paths = 8;    // one after the other

}  // namespace

ImpulseReport ImpulseSolver::solve(ImpulseProblem& problem) {
  ImpulseReport report;
  factorise_trees(problem);
  const std::size_t count = problem.constraints().size();
  memory_.assign(count, {});
  rho0_.assign(count, 0);
  D_.resize(count), u_.resize(count), du_.resize(count), p_.resize(count);
  f_.assign(problem.nv(), 0), dv_.resize(problem.nv()), delta_.resize(problem.nv());
  held_v_.resize(problem.nv());
  std::copy_n(problem.v0(0), problem.tree_count() > 0 ? problem.nv() : 0, problem.v(0));
  find_islands(problem);
  for (std::size_t i = 0; i < count; ++i) {
    const ImpulseConstraint& c = problem.constraints()[i];
    double inverse = 0;
    for (int side = 0; side < 2; ++side) {
      if (c.tree[side] == no_tree) continue;
      const int n = problem.size(c.tree[side]);
      const double *J = problem.J(c, side), *M = problem.M(c.tree[side]);
      for (int k = 0; k < n; ++k) {
        double sum = 0;
        for (int r = 0; r < c.rows; ++r) sum += J[r * n + k] * J[r * n + k];
        inverse += sum / M[k * n + k];
      }
    }
    rho0_[i] = inverse > 0 ? c.rows / inverse : 1;
  }
  link_discs(problem);
  report.islands = static_cast<int>(island_count_);
  solve_again_.resize(static_cast<std::size_t>(problem.tree_count()));
  residual_.assign(solve_again_.size(), 0);
  for (std::size_t i = 0; i < island_count_; ++i) {
    double residual = settle(problem, islands_[i]);
    char& again = solve_again_[static_cast<std::size_t>(islands_[i].trees.front())];
    const bool fails = !(residual <= good_guess);
    bool open = fails || (again && residual > 0.1 * tolerance);
    if (!open && residual > tolerance) {
      residual = relax(problem, islands_[i]);
      open = !(residual <= good_guess);  // where bodies share contacts it can lose what was there
    }
    if (open) {
      residual = solve_island(problem, islands_[i], report);
      // Who takes no guess for good but below the aim (event_driven_step.h) needs the aim.
      const double enough = good_guess < tolerance ? tolerance : accepted;
      if (islands_[i].constraints.size() <= few || !(residual <= enough))
        residual = polish(problem, islands_[i], residual);
    }
    again = fails;
    for (const int t : islands_[i].trees) residual_[static_cast<std::size_t>(t)] = residual;
    report.residual = nan_max(report.residual, residual);
    report.converged = report.converged && residual <= accepted;
  }
  return report;
}

void ImpulseSolver::factorise_trees(const ImpulseProblem& problem) {
  factors_.resize(problem.blocks_size());
  for (int t = 0; t < problem.tree_count(); ++t)
    with_size(problem.size(t),
              [&](auto n) { cholesky(problem.M(t), n, factors_.data() + problem.block(t)); });
}

void ImpulseSolver::solve_tree(const ImpulseProblem& problem, int tree, double* f) const {
  with_size(problem.size(tree),
            [&](auto n) { solve_cholesky(factors_.data() + problem.block(tree), n, f); });
}

// v = v0 + M^-1 J^T p, u of it, and what is left of the laws: of the problem itself, not of the
// rounds'.
double ImpulseSolver::settle(ImpulseProblem& problem, const Island& island) {
  for (const int t : island.trees)
    std::fill_n(f_.begin() + static_cast<std::ptrdiff_t>(problem.first(t)), problem.size(t), 0.0);
  for (const int i : island.constraints)
    problem.add_transpose(problem.constraints()[i], problem.constraints()[i].p, f_.data());
  for (const int t : island.trees) {
    double* change = f_.data() + problem.first(t);
    solve_tree(problem, t, change);
    for (int k = 0; k < problem.size(t); ++k) problem.v(t)[k] = problem.v0(t)[k] + change[k];
  }
  double residual = 0;
  for (const int i : island.constraints) {
    ImpulseConstraint& c = problem.constraints()[i];
    problem.velocity(c, problem.v(0), c.u);
    for (int r = 0; r < c.rows; ++r) c.u[r] += c.b[r];
    if (c.law == ConstraintType::friction_disc)
      memory_[i].radius = c.radius * problem.constraints()[c.of].p[0];
    residual = nan_max(residual, law_residual(c, memory_[i], rho0_[i], c.u, c.p));
  }
  return residual;
}

// One step of projected descent: what a guess leaves open is the same in every step of a body at
// rest, and would add up.
double ImpulseSolver::relax(ImpulseProblem& problem, const Island& island) {
  constexpr double part = 0.125;  // of rho0: up to eight contacts of a body share its inertia
  for (const int i : island.constraints) {
    ImpulseConstraint& c = problem.constraints()[i];
    remember(c, problem.constraints(), c.u, c.p, memory_[i]);
    memory_[i].rho = part * rho0_[i];
    respond(c, memory_[i], DeSaxceShift::frozen, c.u, p_[i], D_[i]);
    if (c.law != ConstraintType::compliant) {
      c.p = p_[i];
    } else {  // what the spring asks for, less what it gives way meanwhile
      for (int r = 0; r < 3; ++r)
        c.p[r] += part * (p_[i][r] - c.p[r]) / (1 + D_[i][4 * r] / rho0_[i]);
    }
  }
  return settle(problem, island);
}

// From what is near the guess; else the rounds from the guess; where that does not do soon, from
// the middle. The best of all is kept, and what it leaves of the laws returned.
double ImpulseSolver::solve_island(ImpulseProblem& problem, const Island& island,
                                   ImpulseReport& report) {
  ++report.solved;
  order(problem, island);
  lay_out(problem, island);
  double best = std::numeric_limits<double>::infinity();
  best_p_.resize(problem.constraints().size()), round_p_.resize(best_p_.size());
  guess_p_.resize(best_p_.size());
  const auto judge = [&](double residual) {
    if (residual < best) {
      best = residual;
      for (const int i : island.constraints) best_p_[i] = problem.constraints()[i].p;
    }
  };
  for (const int i : island.constraints) best_p_[i] = guess_p_[i] = problem.constraints()[i].p;
  const auto go_on = [&](int most, bool yields, double rho) {
    rho_ratio_ = rho;
    run_rounds(problem, island, most, yields, report);
    judge(settle(problem, island));
  };
  if (island.constraints.size() <= few && is_warm(problem, island)) {
    judge(warm_start_newton(problem, island, report));
    if (best <= accepted) return best;
    for (const int i : island.constraints) problem.constraints()[i].p = guess_p_[i];
    settle(problem, island);
  }
  go_on(island.constraints.size() <= few ? quick_newton_few : quick_newton, false, first_rho);
  if (best <= accepted) return best;
  const auto finish = [&](bool yields) {
    judge(settle(problem, island));
    if (best <= accepted) return;
    go_on(max_newton, yields, first_rho);
  };
  report.interior = std::max(report.interior, interior_point_start(problem, island));
  finish(false);
  // A body between two surfaces may slide, or jam with impulses that have no bound; from the middle
  // of what is possible one comes to the jam, even where a hair of a gap makes it no solution.
  for (const double rho : {first_rho, large_rho}) {
    if (best <= accepted) break;
    for (const int i : island.constraints) problem.constraints()[i].p = guess_p_[i];
    settle(problem, island);
    go_on(max_newton, false, rho);
  }
  for (int which = 0; which < max_paths && best > accepted; ++which) {
    report.path = std::max(report.path, follow_path(problem, island, which));
    finish(which % 2 == 1);
  }
  // On from the best, in one way and in the other, as long as that comes nearer.
  for (int k = 0; k < max_returns && best > accepted; ++k) {
    const bool yields = k % 2 == 0;
    for (const int i : island.constraints) problem.constraints()[i].p = best_p_[i];
    const double before = best;
    settle(problem, island);
    go_on(patience * max_newton, yields, first_rho);
    if (!yields && best > 0.5 * before) break;
  }
  // What neither can solve (friction beyond Painleve's bound) is at least brought near, so that
  // nothing falls through.
  const auto max_descents =
      static_cast<int>(std::clamp<std::size_t>(30000 / island.constraints.size(), 300, 5000));
  for (int k = 0; k < max_descents && best > accepted; ++k) judge(relax(problem, island));
  for (const int i : island.constraints) problem.constraints()[i].p = best_p_[i];
  return settle(problem, island);
}

// From p and u of the constraints, v and rho_ratio_. Rounds that go astray are taken back to the
// best, with a smaller rho, which holds them nearer to where they begin. Where they yield, that is
// also done after a round whose shifts could not follow (Levenberg's way): what creeps at a large
// rho may come near at a small one.
void ImpulseSolver::run_rounds(ImpulseProblem& problem, const Island& island, int most, bool yields,
                               ImpulseReport& report) {
  int newton = 0, round = 0;
  double last = 0, best = std::numeric_limits<double>::infinity();
  double max_rho = usual_rho;
  const auto bring_back = [&] {
    for (const int i : island.constraints) problem.constraints()[i].p = round_p_[i];
    settle(problem, island);
  };
  const auto remember_all = [&] {
    for (const int i : island.constraints) {
      const ImpulseConstraint& c = problem.constraints()[i];
      remember(c, problem.constraints(), c.u, c.p, memory_[i]);
    }
  };
  for (const int i : island.constraints) round_p_[i] = problem.constraints()[i].p;
  remember_all();
  // Of many bodies it is above what their errors are at last, and rounds would end on it too early.
  noise_ = island.constraints.size() <= few ? noise(problem, island) : 0;
  while (newton < most) {
    for (const int i : island.constraints) memory_[i].rho = rho_ratio_ * rho0_[i];
    const Round end = solve_round(problem, island, most - newton);
    newton += std::max(1, end.steps);
    ++round;
    for (const int i : island.constraints) {
      ImpulseConstraint& c = problem.constraints()[i];
      c.p = p_[i], c.u = u_[i];
    }
    double residual = end.left;  // a round that had no time to end is no solution
    for (const int i : island.constraints) {
      const ImpulseConstraint& c = problem.constraints()[i];
      remember(c, problem.constraints(), c.u, c.p, memory_[i]);
      residual = nan_max(residual, law_residual(c, memory_[i], rho0_[i], c.u, c.p));
    }
    report.rounds = std::max(report.rounds, round);
    report.newton = std::max(report.newton, newton);
    if (residual <= 0.3 * tolerance) return;
    if (residual < best) {
      best = residual;
      for (const int i : island.constraints) round_p_[i] = problem.constraints()[i].p;
    } else if (!(residual <= astray * best) && rho_ratio_ > min_rho) {
      bring_back();
      remember_all();
      max_rho = rho_ratio_ = std::max(min_rho, 0.01 * rho_ratio_);
      last = best;
      continue;
    }
    // Multipliers that creep while the active laws stay the same need a larger rho.
    const bool creeps = end.steps <= 2 && residual > 0.3 * last;
    if (yields && end.strayed)
      rho_ratio_ = std::max(min_rho, 0.1 * rho_ratio_);
    else if (rho_ratio_ < max_rho || (creeps && rho_ratio_ < max_rho))
      rho_ratio_ *= 10;
    last = residual;
  }
  if (!(last <= best)) bring_back();
}

}  // namespace twinarm
