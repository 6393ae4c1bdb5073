// A start for the rounds of impulse_solver.h where many contacts change at once: an interior-point
// method on the exact laws, de Saxce's term included (in the manner of Acary, Armand, Nguyen and
// Shpakovych 2023).
//
// For each contact, with T = diag(1/mu, 1, 1):  z = T (u + mu |u_t| e_n),  p = T x,
//   x, z in Q,  x o z = s e,  s -> 0,
// linearised in Nesterov and Todd's scaling, W z = W^-1 x = t:
//   dx = W (t \ (s e - t o t - corrector)) - W^2 dz,    dz = T E J dv + r_z,
// E = 1 + e_n (0, mu u_t / |u_t|). So again one system in the velocities,
//   (M + J^T T W^2 T E J) dv = ...,
// which is not symmetric. Ten to thirty iterations from any start, whatever is redundant: the
// impulses end in the middle of what is possible, so that the next step can begin with them. What
// is not a contact follows its response (impulse_law.h), its multiplier renewed each time.
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/impulse_central.h"
#include "solver/impulse_solver.h"

namespace twinarm {
namespace {

constexpr double poor_step = 0.5, stuck_step = 0.05, least_centering = 0.1;
constexpr int most_iterations = 60, most_stuck = 3;
constexpr double held_rho = 1e4;  // times rho0, of what is not a contact

}  // namespace

int ImpulseSolver::approach_centrally(ImpulseProblem& problem, const Island& island) {
  begin_centrally(problem, island);
  shift_part_ = 1, rounded_ = 0;
  double step = 1, best = std::numeric_limits<double>::infinity();
  int iterations = 0, stuck = 0;
  for (; iterations < most_iterations && stuck <= most_stuck; ++iterations) {
    double residual = 0;
    const double mean = measure_centrally(problem, island, residual);
    if (!(mean > 0) || !(residual < 1e100)) break;
    if (residual < best) {
      best = residual;
      for (const int i : island.constraints) kept_[i] = p_[i];
    }
    if (residual <= tolerance) break;
    assemble(problem, island, false);
    matrix_.factorise(false);
    const double affine = std::min(1.0, direct_centrally(problem, island, 0, false));
    double after = 0;
    for (const int i : island.constraints)
      if (is_cone(problem.constraints()[i]))
        for (int r = 0; r < 3; ++r)
          after += (x_[i][r] + affine * dx_[i][r]) * (z_[i][r] + affine * dz_[i][r]);
    const double ratio = std::max(0.0, after / (mean * cones_));
    double centering = std::clamp(ratio * ratio * ratio, least_centering, 1.0);
    const bool correct = step >= poor_step;  // after a poor step back to the middle first
    if (!correct) centering = std::max(centering, 0.3);
    step = std::min(1.0, 0.99 * direct_centrally(problem, island, centering * mean, correct));
    stuck += step < stuck_step;
    move_centrally(problem, island, step);
  }
  for (const int i : island.constraints) problem.constraints()[i].p = kept_[i];
  return iterations;
}

// x and z on the axes of their cones, as large as the impulses and velocities that are at stake.
void ImpulseSolver::begin_centrally(ImpulseProblem& problem, const Island& island) {
  const std::size_t count = problem.constraints().size();
  x_.resize(count), z_.resize(count), dx_.resize(count), dz_.resize(count), d_.resize(count);
  r_z_.resize(count), right_.resize(count), lift_.resize(count), scaling_.resize(count);
  kept_.resize(count);
  rho_ratio_ = held_rho;
  for (const int t : island.trees) std::copy_n(problem.v0(t), problem.size(t), problem.v(t));
  double speed = 1e-6, impulse = 1e-9;
  cones_ = 0;
  for (const int i : island.constraints) {
    ImpulseConstraint& c = problem.constraints()[i];
    memory_[i].rho = rho_ratio_ * rho0_[i];
    memory_[i].l = c.p;
    x_[i] = z_[i] = dx_[i] = dz_[i] = {};
    if (!is_cone(c)) continue;
    ++cones_;
    problem.velocity(c, problem.v(0), c.u);
    for (int r = 0; r < c.rows; ++r) {
      speed = std::max(speed, std::abs(c.u[r] + c.b[r]));
      impulse = std::max(impulse, rho0_[i] * std::abs(c.u[r] + c.b[r]));
    }
  }
  for (const int i : island.constraints)
    if (is_cone(problem.constraints()[i])) x_[i][0] = impulse, z_[i][0] = speed;
}

// p, u, what is left of every equation, and the matrices D of the contacts. Returns the mean of x
// z.
double ImpulseSolver::measure_centrally(ImpulseProblem& problem, const Island& island,
                                        double& residual) {
  double sum = 0;
  residual = 0;
  for (const int t : island.trees)
    std::fill_n(f_.begin() + static_cast<std::ptrdiff_t>(problem.first(t)), problem.size(t), 0.0);
  for (const int i : island.constraints) {
    ImpulseConstraint& c = problem.constraints()[i];
    problem.velocity(c, problem.v(0), c.u);
    for (int r = 0; r < c.rows; ++r) c.u[r] += c.b[r];
    if (c.law == ImpulseLaw::disc) memory_[i].radius = c.radius * problem.constraints()[c.of].p[0];
    if (c.law == ImpulseLaw::compliant) memory_[i].radius = c.mu * c.p[0];
    if (is_cone(c)) {
      c.p = scaled(c, x_[i]);
      sum += cone_dot(x_[i], z_[i]);
      const double slip = smooth_slip(c.u), part = shift_part_ * c.mu;
      const double lift = c.law == ImpulseLaw::coulomb ? part * slip : 0;
      const Vec exact = scaled(c, {c.u[0] + lift, c.u[1], c.u[2]});
      for (int r = 0; r < 3; ++r) r_z_[i][r] = exact[r] - z_[i][r];
      lift_[i] = {0, 0};
      if (slip > 0) lift_[i] = {part * c.u[1] / slip, part * c.u[2] / slip};
      scaling_[i] = nesterov_todd(x_[i], z_[i]);
      const double T = inverse_mu(c);
      for (int r = 0; r < 3; ++r)
        for (int k = 0; k < 3; ++k)
          D_[i][3 * r + k] = scaling_[i].W2[3 * r + k] * (r == 0 ? T : 1) * (k == 0 ? T : 1);
      for (int r = 0; r < 9; r += 3)
        D_[i][r + 1] += D_[i][r] * lift_[i][0], D_[i][r + 2] += D_[i][r] * lift_[i][1];
    } else {
      respond(c, memory_[i], Shift::held, c.u, c.p, D_[i]);
      memory_[i].l = c.p;
    }
    p_[i] = c.p, u_[i] = c.u;
    problem.add_transpose(c, c.p, f_.data());
    residual = std::max(residual, law_residual(c, memory_[i], rho0_[i], c.u, c.p));
  }
  residual = std::max(residual, balance(problem, island).largest);
  return sum / std::max(1, cones_);
}

// dv_, dx_ and dz_ towards x o z = s e; the corrector is that of the direction before. Returns how
// far the cones let go.
double ImpulseSolver::direct_centrally(ImpulseProblem& problem, const Island& island, double s,
                                       bool correct) {
  for (const int i : island.constraints) {
    if (!is_cone(problem.constraints()[i])) continue;
    const ConeScaling& scaling = scaling_[i];
    const Vec square = jordan(scaling.t, scaling.t);
    right_[i] = {s - square[0], -square[1], -square[2]};
    if (!correct) continue;
    const Vec Wdz = times(scaling.W, dz_[i]);
    const Vec Wdx{-scaling.t[0] - Wdz[0], -scaling.t[1] - Wdz[1], -scaling.t[2] - Wdz[2]};
    const Vec second = jordan(Wdz, Wdx);
    for (int r = 0; r < 3; ++r) right_[i][r] -= second[r];
  }
  solve_centrally(problem, island, r_z_, 1);
  double farthest = std::numeric_limits<double>::infinity();
  for (const int i : island.constraints)
    if (is_cone(problem.constraints()[i]))
      farthest = std::min({farthest, cone_step(x_[i], dx_[i]), cone_step(z_[i], dz_[i])});
  return farthest;
}

// dv_, dx_ and dz_ of the linearised equations:  t o (W dz + W^-1 dx) = right_,  dz = T E J dv + r,
// M dv = J^T T dx - part rhs_. matrix_ is factorised.
void ImpulseSolver::solve_centrally(const ImpulseProblem& problem, const Island& island,
                                    const std::vector<ConeVec>& r, double part) {
  for (const int t : island.trees)
    std::fill_n(f_.begin() + static_cast<std::ptrdiff_t>(problem.first(t)), problem.size(t), 0.0);
  for (const int i : island.constraints) {
    const ImpulseConstraint& c = problem.constraints()[i];
    if (!is_cone(c)) continue;
    d_[i] = times(scaling_[i].W, jordan_solve(scaling_[i].t, right_[i]));
    const Vec W2r = times(scaling_[i].W2, r[i]);
    const Vec q{d_[i][0] - W2r[0], d_[i][1] - W2r[1], d_[i][2] - W2r[2]};
    problem.add_transpose(c, scaled(c, q), f_.data());
  }
  step_rhs_.resize(rhs_.size());
  const auto for_each_row = [&](auto&& f) {
    for (const int t : island.trees)
      for (std::size_t k = 0; k < static_cast<std::size_t>(problem.size(t)); ++k)
        f(row_[t] + k, problem.first(t) + k);
  };
  for_each_row(
      [&](std::size_t row, std::size_t at) { step_rhs_[row] = f_[at] - part * rhs_[row]; });
  matrix_.solve(step_rhs_.data());
  for_each_row([&](std::size_t row, std::size_t at) { dv_[at] = step_rhs_[row]; });
  for (const int i : island.constraints) {
    const ImpulseConstraint& c = problem.constraints()[i];
    if (!is_cone(c)) continue;
    Vec du;
    problem.velocity(c, dv_.data(), du);
    du[0] += lift_[i][0] * du[1] + lift_[i][1] * du[2];
    const Vec Tdu = scaled(c, du);
    for (int k = 0; k < 3; ++k) dz_[i][k] = Tdu[k] + r[i][k];
    const Vec W2dz = times(scaling_[i].W2, dz_[i]);
    for (int k = 0; k < 3; ++k) dx_[i][k] = d_[i][k] - W2dz[k];
  }
}

void ImpulseSolver::move_centrally(ImpulseProblem& problem, const Island& island, double step) {
  for (const int i : island.constraints)
    for (int r = 0; r < 3; ++r) x_[i][r] += step * dx_[i][r], z_[i][r] += step * dz_[i][r];
  move(problem, island, step);
}

}  // namespace twinarm
