// Newton steps with a multiplier update each: 3 to 7 from a guess close to the solution (a sliding
// contact from step to step), 1 or 2 to refine a solution to rounding.
//
// Each step sets l = p and linearises p(u) of impulse_law.h, with differentiated shift, at a rho
// large enough to identify the active set. A contact whose guess is too large gets u_n > 0; with a
// large rho it would be projected to zero impulse,
//   l - rho (u + mu |u_t| e_n) in the polar cone  <=  rho u_n > (1 + mu^2) l_n,
// and the bodies would penetrate. rho is therefore limited to keep half of the impulse; as u_n
// decreases rho rises, and each step then reduces the error to 1/1000.
#include <algorithm>
#include <limits>

#include "solver/impulses/impulse_solver.h"

namespace twinarm {
namespace {

constexpr double kWarmStartRho = 1e3, kRefinementRho = 1e2;  // rho / rho0
constexpr int kMaxWarmStartSteps = 8, kMaxFailures = 2;

// rho, limited so that an active contact keeps an impulse.
double limited_rho(const ImpulseConstraint& c, double rho) {
  if (!is_contact(c) || !(c.p[0] > 0) || !(c.u[0] > 0)) return rho;
  return std::min(rho, 0.5 * (1 + c.mu * c.mu) * c.p[0] / c.u[0]);
}

// p -= D u
void subtract_product(const Mat& D, const Vec& u, Vec& p) {
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t k = 0; k < 3; ++k) p[r] -= D[3 * r + k] * u[k];
}

}  // namespace

// With rho of multipliers_. Returns the residual of the laws; `residual` if the gradient is zero.
double ImpulseSolver::semismooth_newton_step(double residual) {
  const Gradient now = gradient(DeSaxceShift::differentiated);
  if (!(now.squared > 0)) return residual;
  find_direction(false);
  if (is_exact_to_rounding()) {  // p(u) + dp, without the rounding of rho (u + du)
    for (const int i : island_->constraints) problem_->velocity(constraint(i), dv_.data(), du_[i]);
    for (const int i : island_->constraints) subtract_product(D_[i], du_[i], p_[i]);
    for (const CouplingBlock& b : coupling_blocks_) subtract_product(b.D, du_[b.by], p_[b.of]);
  } else {
    move(1);
    gradient(DeSaxceShift::differentiated);
  }
  return apply_impulses(p_);
}

// Whether any contact has an impulse in the guess.
bool ImpulseSolver::has_warm_start() const {
  return std::ranges::any_of(island_->constraints, [&](int i) {
    const ConstraintType law = constraint(i).law;
    return (law == ConstraintType::coulomb_cone && constraint(i).p[0] > 0) ||
           (law == ConstraintType::bilateral && is_exact_to_rounding());
  });
}

// Returns the residual of the laws; infinity if no step was taken.
double ImpulseSolver::warm_start_newton(ImpulseReport& report) {
  rho_ratio_ = kWarmStartRho;
  double residual = std::numeric_limits<double>::infinity();
  int steps = 0, failures = 0;
  while (steps < kMaxWarmStartSteps && failures < kMaxFailures && residual > tolerance) {
    update_multipliers();
    for (const int i : island_->constraints)
      multipliers_[i].rho = limited_rho(constraint(i), rho_ratio_ * rho0_[i]);
    const double before = residual;
    residual = semismooth_newton_step(residual);
    failures += !(residual < 0.5 * before);
    ++steps;
  }
  report.newton = std::max(report.newton, steps);
  return residual;
}

// Refines a solution to rounding while the residual decreases; rho is small, so that rounding of u
// has little effect.
double ImpulseSolver::refine_solution(double residual) {
  constexpr int max_steps = 3;
  rho_ratio_ = kRefinementRho;
  for (int k = 0; k < max_steps && residual > 0.01 * tolerance; ++k) {
    update_multipliers();
    for (const int i : island_->constraints) {
      multipliers_[i].rho = rho_ratio_ * rho0_[i];
      best_p_[i] = constraint(i).p;
    }
    const double before = residual;
    residual = semismooth_newton_step(residual);
    if (residual < 0.5 * before) continue;
    if (residual < before) break;
    return apply_impulses(best_p_);
  }
  return residual;
}

}  // namespace twinarm
