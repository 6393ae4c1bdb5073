// Inner problem of newton_phase.h: semismooth Newton method.
#include <cmath>
#include <limits>

#include "solver/impulses/newton_phase.h"
#include "solver/linear_algebra/second_order_cone.h"

namespace twinarm {

// Convex problem with frozen shifts; then Newton steps with differentiated shift from its solution.
// These have no merit function: they are accepted only while |gradient| decreases, with step
// halving if the budget permits; otherwise the convex solution is restored.
NewtonPhase::InnerResult NewtonPhase::solve_inner_problem(int max_steps) {
  ImpulseProblem& problem = *island_.problem;
  InnerResult result;
  int& steps = result.steps;
  for (Gradient now = gradient(DeSaxceShift::frozen);
       steps < max_steps && now.largest > now.tolerance; now = gradient(DeSaxceShift::frozen)) {
    find_direction(true);
    const double step = step_length();
    island_.move(step);
    ++steps;
    if (step == 1 && now.largest < 1e2 * now.tolerance) break;
  }
  island_.for_each_velocity([&](std::size_t k) { convex_v_[k] = problem.v(0)[k]; });
  Gradient now = gradient(DeSaxceShift::differentiated);
  result.error = now.error();
  while (steps < max_steps && now.largest > now.tolerance) {
    find_direction(false);
    island_.move(1);
    ++steps;
    Gradient then = gradient(DeSaxceShift::differentiated);
    double step = 1;
    if (max_steps > kFewSteps)
      for (; !(then.squared < (1 - 0.5 * step) * now.squared) && step > 0.05; step *= 0.5) {
        island_.move(-0.5 * step);
        then = gradient(DeSaxceShift::differentiated);
      }
    if (!(then.squared < (step < 1 ? 1 - 0.5 * step : 0.25) * now.squared)) {
      island_.for_each_velocity([&](std::size_t k) { problem.v(0)[k] = convex_v_[k]; });
      result.error = gradient(DeSaxceShift::frozen).error();
      break;
    }
    now = then;
    result.error = now.error();
  }
  return result;
}

// u, p and D at v; balance = M (v - v0) - J^T p.
NewtonPhase::Gradient NewtonPhase::gradient(DeSaxceShift shift) {
  ImpulseProblem& problem = *island_.problem;
  island_.zero_forces();
  double fastest = 0;
  island_.coupling.clear();
  for (const int i : island_.constraints()) {
    const ImpulseConstraint& c = island_.constraint(i);
    problem.velocity(c, problem.v(0), island_.u[i]);
    for (int r = 0; r < c.rows; ++r) island_.u[i][r] += c.b[r];
    if (c.law == ConstraintType::friction_disc && shift == DeSaxceShift::differentiated)
      project_disc(c, i);
    else
      project_impulse(c, island_.multipliers[i], shift, island_.u[i], island_.p[i], island_.D[i]);
    problem.add_transpose(c, island_.p[i], island_.forces.data());
    fastest = std::max(
        {fastest, std::abs(island_.u[i][0]), std::abs(island_.u[i][1]), std::abs(island_.u[i][2])});
  }
  Gradient all{island_.momentum_balance()};
  all.noise = rho_ratio_ * rounding_error_;
  all.tolerance =
      std::max({0.01 * island_.wanted.tolerance, 2e-14 * rho_ratio_ * fastest, all.noise});
  return all;
}

// Rounding error of the gradient for rho = rho0, as a velocity [m/s, rad/s]: p = l - rho u, and u
// is a sum that cancels (rolling contact), with rounding of its terms.
double NewtonPhase::rounding_error() {
  ImpulseProblem& problem = *island_.problem;
  island_.zero_forces();
  const auto for_each_side = [&](const ImpulseConstraint& c, auto&& f) {
    for (int side = 0; side < 2; ++side)
      if (const int t = c.tree[side]; t != ImpulseConstraint::no_tree)
        f(problem.J(c, side), problem.size(t), t);
  };
  for (const int i : island_.constraints()) {
    const ImpulseConstraint& c = island_.constraint(i);
    Vec terms{std::abs(c.b[0]), std::abs(c.b[1]), std::abs(c.b[2])};
    for_each_side(c, [&](const double* J, int n, int t) {
      for (int r = 0; r < c.rows; ++r)
        for (int k = 0; k < n; ++k) terms[r] += std::abs(J[r * n + k] * problem.v(t)[k]);
    });
    for_each_side(c, [&](const double* J, int n, int t) {
      for (int r = 0; r < c.rows; ++r)
        for (int k = 0; k < n; ++k)
          island_.forces[problem.first(t) + static_cast<std::size_t>(k)] +=
              island_.rho0[i] * terms[r] * std::abs(J[r * n + k]);
    });
  }
  double largest = 0;
  for (const int t : island_.trees())
    for (int k = 0; k < problem.size(t); ++k)
      largest = std::max(largest, island_.forces[problem.first(t) + static_cast<std::size_t>(k)] /
                                      problem.M(t)[k * problem.size(t) + k]);
  return std::numeric_limits<double>::epsilon() * largest;
}

// Disc with the radius of the contact's p_n at this u, differentiated.
void NewtonPhase::project_disc(const ImpulseConstraint& c, int i) {
  MultiplierState state = island_.multipliers[i];
  state.radius = c.radius * std::max(0.0, island_.p[c.of][0]);
  project_impulse(c, state, DeSaxceShift::differentiated, island_.u[i], island_.p[i], island_.D[i]);
  const Vec direction = sliding_direction(c, state, island_.u[i]);
  if (direction == Vec{}) return;
  auto& block = island_.coupling.emplace_back(ImpulseIsland::CouplingBlock{i, c.of, {}});
  for (int r = 0; r < c.rows; ++r)
    for (int k = 0; k < 3; ++k) block.D[3 * r + k] = c.radius * direction[r] * island_.D[c.of][k];
}

// dv = -(M + J^T D J)^-1 balance
void NewtonPhase::find_direction(bool symmetric) {
  matrix_.factorise(symmetric);
  island_.for_each_velocity([&](std::size_t k) { island_.dv[k] = -island_.balance[k]; });
  matrix_.solve(island_.dv);
}

// Line search: zero of the slope along dv, which is monotone (convex objective).
double NewtonPhase::step_length() {
  ImpulseProblem& problem = *island_.problem;
  double slope0 = 0, curvature = 0;  // of 1/2 |v - v0|_M^2
  for (const int t : island_.trees()) {
    const int n = problem.size(t);
    const double *dv = island_.dv.data() + problem.first(t), *change = island_.change(t);
    const double* M = problem.M(t);
    for (int r = 0; r < n; ++r)
      for (int k = 0; k < n; ++k) {
        slope0 += dv[r] * M[r * n + k] * change[k];
        curvature += dv[r] * M[r * n + k] * dv[k];
      }
  }
  double start = slope0;
  for (const int i : island_.constraints()) {
    problem.velocity(island_.constraint(i), island_.dv.data(), island_.du[i]);
    start -= cone_dot(island_.p[i], island_.du[i]);
  }
  const auto slope = [&](double s) {
    double sum = slope0 + s * curvature;
    for (const int i : island_.constraints()) {
      Vec u = island_.u[i];
      for (int r = 0; r < 3; ++r) u[r] += s * island_.du[i][r];
      sum -= cone_dot(project_impulse(island_.constraint(i), island_.multipliers[i], u),
                      island_.du[i]);
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
