#include "solver/impulses/newton_phase.h"

#include <limits>

namespace twinarm {
namespace {

// Penalty rho, relative to rho0.
constexpr double kDefaultMaxRho = 1e5, kMaxRho = 1e7, kMinRho = 1;
constexpr double kWarmStartRho = 1e3, kRefinementRho = 1e2;
constexpr double kDivergence = 10;  // residual relative to the best one
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

// If the residual grows, restart from the best iterate with a smaller rho, which keeps the inner
// solutions closer to the start.
void NewtonPhase::solve(int max_steps, double rho, ImpulseReport& report) {
  rho_ratio_ = rho;
  iterate_p_.resize(island_.p.size()), convex_v_.resize(island_.dv.size());
  int newton = 0;
  double last = 0, best = std::numeric_limits<double>::infinity();
  double max_rho = kDefaultMaxRho;
  for (const int i : island_.constraints()) iterate_p_[i] = island_.constraint(i).p;
  island_.update_multipliers();
  // For many bodies the bound is larger than their final errors and would end iterations too early.
  rounding_error_ = island_.is_small() ? rounding_error() : 0;
  while (newton < max_steps && island_.has_budget()) {
    for (const int i : island_.constraints())
      island_.multipliers[i].rho = rho_ratio_ * island_.rho0[i];
    const InnerResult inner = solve_inner_problem(max_steps - newton);
    newton += std::max(1, inner.steps);
    double residual = inner.error;
    for (const int i : island_.constraints()) {
      ImpulseConstraint& c = island_.constraint(i);
      c.p = island_.p[i], c.u = island_.u[i];
      update_multiplier(c, island_.problem->constraints(), c.u, c.p, island_.multipliers[i]);
      residual =
          nan_max(residual, law_residual(c, island_.multipliers[i], island_.rho0[i], c.u, c.p));
    }
    report.newton = std::max(report.newton, newton);
    if (residual <= 0.3 * island_.wanted.tolerance)
      return island_.keep_best(island_.apply_impulses());
    if (residual < best) {
      best = residual;
      for (const int i : island_.constraints()) iterate_p_[i] = island_.constraint(i).p;
    } else if (!(residual <= kDivergence * best) && rho_ratio_ > kMinRho) {
      island_.apply_impulses(iterate_p_);
      island_.update_multipliers();
      max_rho = rho_ratio_ = std::max(kMinRho, 0.01 * rho_ratio_);
      last = best;
      continue;
    }
    // Slow convergence of the multipliers with a constant active set requires a larger rho.
    const bool slow = inner.steps <= 2 && residual > 0.3 * last;
    if (rho_ratio_ < max_rho || (slow && rho_ratio_ < kMaxRho)) rho_ratio_ *= 10;
    last = residual;
  }
  if (!(last <= best)) island_.apply_impulses(iterate_p_);
  island_.keep_best(island_.apply_impulses());
}

// With rho of the multipliers. Returns the residual of the laws; `residual` if the gradient is
// zero.
double NewtonPhase::semismooth_step(double residual) {
  const Gradient now = gradient(DeSaxceShift::differentiated);
  if (!(now.squared > 0)) return residual;
  find_direction(false);
  if (island_.wanted.is_to_rounding()) {  // p(u) + dp, without the rounding of rho (u + du)
    std::vector<Vec>&p = island_.p, &du = island_.du;
    for (const int i : island_.constraints())
      island_.problem->velocity(island_.constraint(i), island_.dv.data(), du[i]);
    for (const int i : island_.constraints()) subtract_product(island_.D[i], du[i], p[i]);
    for (const auto& block : island_.coupling) subtract_product(block.D, du[block.by], p[block.of]);
  } else {
    island_.move(1);
    gradient(DeSaxceShift::differentiated);
  }
  return island_.apply_impulses(island_.p);
}

// Each step sets l = p and linearises p(u) of impulse_law.h, with differentiated shift, at a rho
// large enough to identify the active set. A contact whose guess is too large gets u_n > 0; with a
// large rho it would be projected to zero impulse,
//   l - rho (u + mu |u_t| e_n) in the polar cone  <=  rho u_n > (1 + mu^2) l_n,
// and the bodies would penetrate. rho is therefore limited to keep half of the impulse; as u_n
// decreases rho rises, and each step then reduces the error to 1/1000.
double NewtonPhase::solve_near(ImpulseReport& report) {
  rho_ratio_ = kWarmStartRho;
  double residual = std::numeric_limits<double>::infinity();
  int steps = 0, failures = 0;
  while (steps < kMaxWarmStartSteps && failures < kMaxFailures &&
         residual > island_.wanted.tolerance) {
    island_.update_multipliers();
    for (const int i : island_.constraints())
      island_.multipliers[i].rho = limited_rho(island_.constraint(i), rho_ratio_ * island_.rho0[i]);
    const double before = residual;
    residual = semismooth_step(residual);
    failures += !(residual < 0.5 * before);
    ++steps;
  }
  report.newton = std::max(report.newton, steps);
  return residual;
}

// rho is small, so that rounding of u has little effect.
double NewtonPhase::refine(double residual) {
  constexpr int max_steps = 3;
  rho_ratio_ = kRefinementRho;
  for (int k = 0; k < max_steps && residual > 0.01 * island_.wanted.tolerance; ++k) {
    island_.update_multipliers();
    for (const int i : island_.constraints()) {
      island_.multipliers[i].rho = rho_ratio_ * island_.rho0[i];
      island_.best_p[i] = island_.constraint(i).p;
    }
    const double before = residual;
    residual = semismooth_step(residual);
    if (residual < 0.5 * before) continue;
    if (residual < before) break;
    return island_.apply_impulses(island_.best_p);
  }
  return residual;
}

}  // namespace twinarm
