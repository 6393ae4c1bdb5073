// Rounds of one Newton step: where a solution is near, as from step to step of a sliding contact,
// three to seven of them find it, and what rounding has left of one goes with one or two.
//
// Each begins with l = p of the round before and linearises p(u) of impulse_law.h, its shift
// following, at a rho that makes it see which laws are active. A contact that pressed in the step
// before, and whose guess presses too hard, parts: u_n > 0. A large rho would take it for one that
// has let go,
//   l - rho (u + mu |u_t| e_n) in the polar cone  <=  rho u_n > (1 + mu^2) l_n,
// and the bodies would fall into one another. So its rho is small enough to leave it half of its
// impulse; as u_n falls it rises, and from there on each round takes an error to 1/1000 of it.
#include <algorithm>
#include <limits>
#include <vector>

#include "solver/impulses/impulse_solver.h"

namespace twinarm {
namespace {

constexpr double near_rho = 1e3, polish_rho = 1e2;  // times rho0
constexpr int max_near = 8, max_in_vain = 2;

// The largest rho by which c, if it presses, goes on to press.
double holding_rho(const ImpulseConstraint& c, double rho) {
  const bool is_contact =
      c.law == ConstraintType::coulomb_cone || c.law == ConstraintType::unilateral;
  if (!is_contact || !(c.p[0] > 0) || !(c.u[0] > 0)) return rho;
  return std::min(rho, 0.5 * (1 + c.mu * c.mu) * c.p[0] / c.u[0]);
}

}  // namespace

// With the rho that memory_ has. Returns what is left of the laws; `residual` where there is
// nothing to do.
double ImpulseSolver::semismooth_newton_step(ImpulseProblem& problem, const Island& island,
                                             double residual) {
  const Gradient now = gradient(problem, island, DeSaxceShift::differentiated);
  if (!(now.squared > 0)) return residual;
  find_direction(problem, island, false);
  move(problem, island, 1);
  gradient(problem, island, DeSaxceShift::differentiated);
  for (const int i : island.constraints) problem.constraints()[i].p = p_[i];
  return settle(problem, island);
}

// Whether the guess says anything.
bool ImpulseSolver::is_warm(const ImpulseProblem& problem, const Island& island) {
  const std::vector<ImpulseConstraint>& all = problem.constraints();
  return std::any_of(island.constraints.begin(), island.constraints.end(), [&](int i) {
    return all[i].law == ConstraintType::coulomb_cone && all[i].p[0] > 0;
  });
}

// Returns what is left of the laws; infinity where there is nothing to do.
double ImpulseSolver::warm_start_newton(ImpulseProblem& problem, const Island& island,
                                        ImpulseReport& report) {
  const std::vector<ImpulseConstraint>& all = problem.constraints();
  rho_ratio_ = near_rho;
  double residual = std::numeric_limits<double>::infinity();
  int steps = 0, in_vain = 0;
  while (steps < max_near && in_vain < max_in_vain && residual > tolerance) {
    for (const int i : island.constraints) {
      remember(all[i], all, all[i].u, all[i].p, memory_[i]);
      memory_[i].rho = holding_rho(all[i], rho_ratio_ * rho0_[i]);
    }
    const double before = residual;
    residual = semismooth_newton_step(problem, island, residual);
    in_vain += !(residual < 0.5 * before);
    ++steps;
  }
  report.rounds = std::max(report.rounds, steps);
  report.newton = std::max(report.newton, steps);
  return residual;
}

// From a solution to one whose digits are all right, as long as that comes nearer: with a rho that
// is small enough for the rounding of u to do no harm.
double ImpulseSolver::polish(ImpulseProblem& problem, const Island& island, double residual) {
  constexpr int most = 3;
  rho_ratio_ = polish_rho;
  for (int k = 0; k < most && residual > 0.01 * tolerance; ++k) {
    for (const int i : island.constraints) {
      const ImpulseConstraint& c = problem.constraints()[i];
      remember(c, problem.constraints(), c.u, c.p, memory_[i]);
      memory_[i].rho = rho_ratio_ * rho0_[i];
      best_p_[i] = c.p;
    }
    const double before = residual;
    residual = semismooth_newton_step(problem, island, residual);
    if (residual < 0.5 * before) continue;
    if (residual < before) break;
    for (const int i : island.constraints) problem.constraints()[i].p = best_p_[i];
    return settle(problem, island);
  }
  return residual;
}

}  // namespace twinarm
