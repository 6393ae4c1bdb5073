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

#include "solver/impulse_solver.h"

namespace twinarm {
namespace {

constexpr double poor_step = 0.5, stuck_step = 0.05;
constexpr int most_iterations = 60, most_stuck = 3;

bool is_cone(const ImpulseConstraint& c) {
  return c.law == ImpulseLaw::at_least || c.law == ImpulseLaw::coulomb;
}
double inverse_mu(const ImpulseConstraint& c) {
  return c.law == ImpulseLaw::coulomb ? 1 / c.mu : 1;
}
Vec scaled(const ImpulseConstraint& c, const Vec& a) {  // T a
  return {inverse_mu(c) * a[0], a[1], a[2]};
}

}  // namespace

int ImpulseSolver::approach_centrally(ImpulseProblem& problem, const Island& island,
                                      double least_centering) {
  begin_centrally(problem, island);
  rho_ratio_ = 1e4;
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
    for (const int i : island.constraints)
      for (int r = 0; r < 3; ++r) x_[i][r] += step * dx_[i][r], z_[i][r] += step * dz_[i][r];
    move(problem, island, step);
  }
  for (const int i : island.constraints) problem.constraints()[i].p = kept_[i];
  return iterations;
}

// x and z on the axes of their cones, as large as the impulses and velocities that are at stake.
void ImpulseSolver::begin_centrally(ImpulseProblem& problem, const Island& island) {
  const std::size_t count = problem.constraints().size();
  x_.resize(count), z_.resize(count), dx_.resize(count), dz_.resize(count), d_.resize(count);
  r_z_.resize(count), lift_.resize(count), scaling_.resize(count), kept_.resize(count);
  for (const int t : island.trees) std::copy_n(problem.v0(t), problem.size(t), problem.v(t));
  double speed = 1e-6, impulse = 1e-9;
  cones_ = 0;
  for (const int i : island.constraints) {
    ImpulseConstraint& c = problem.constraints()[i];
    memory_[i].rho = 1e4 * rho0_[i];
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
      const double slip = std::sqrt(c.u[1] * c.u[1] + c.u[2] * c.u[2]);
      const Vec exact = scaled(c, {c.u[0] + shift_of(c, c.u), c.u[1], c.u[2]});
      for (int r = 0; r < 3; ++r) r_z_[i][r] = exact[r] - z_[i][r];
      lift_[i] = {0, 0};
      if (slip > 0) lift_[i] = {c.mu * c.u[1] / slip, c.mu * c.u[2] / slip};
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
  for (const int t : island.trees)
    std::fill_n(f_.begin() + static_cast<std::ptrdiff_t>(problem.first(t)), problem.size(t), 0.0);
  for (const int i : island.constraints) {
    const ImpulseConstraint& c = problem.constraints()[i];
    if (!is_cone(c)) continue;
    const ConeScaling& scaling = scaling_[i];
    const Vec square = jordan(scaling.t, scaling.t);
    Vec right{s - square[0], -square[1], -square[2]};
    if (correct) {
      const Vec Wdz = times(scaling.W, dz_[i]);
      const Vec Wdx{-scaling.t[0] - Wdz[0], -scaling.t[1] - Wdz[1], -scaling.t[2] - Wdz[2]};
      const Vec second = jordan(Wdz, Wdx);
      for (int r = 0; r < 3; ++r) right[r] -= second[r];
    }
    d_[i] = times(scaling.W, jordan_solve(scaling.t, right));
    const Vec W2r = times(scaling.W2, r_z_[i]);
    Vec q{d_[i][0] - W2r[0], d_[i][1] - W2r[1], d_[i][2] - W2r[2]};
    problem.add_transpose(c, scaled(c, q), f_.data());
  }
  step_rhs_.assign(rhs_.begin(), rhs_.end());
  for (const int t : island.trees)
    for (int k = 0; k < problem.size(t); ++k) {
      const auto at = static_cast<std::size_t>(k);
      step_rhs_[row_[t] + at] = f_[problem.first(t) + at] - rhs_[row_[t] + at];
    }
  matrix_.solve(step_rhs_.data());
  for (const int t : island.trees)
    for (int k = 0; k < problem.size(t); ++k) {
      const auto at = static_cast<std::size_t>(k);
      dv_[problem.first(t) + at] = step_rhs_[row_[t] + at];
    }
  double farthest = std::numeric_limits<double>::infinity();
  for (const int i : island.constraints) {
    const ImpulseConstraint& c = problem.constraints()[i];
    if (!is_cone(c)) continue;
    Vec du;
    problem.velocity(c, dv_.data(), du);
    du[0] += lift_[i][0] * du[1] + lift_[i][1] * du[2];
    const Vec Tdu = scaled(c, du);
    for (int r = 0; r < 3; ++r) dz_[i][r] = Tdu[r] + r_z_[i][r];
    const Vec W2dz = times(scaling_[i].W2, dz_[i]);
    for (int r = 0; r < 3; ++r) dx_[i][r] = d_[i][r] - W2dz[r];
    farthest = std::min({farthest, cone_step(x_[i], dx_[i]), cone_step(z_[i], dz_[i])});
  }
  return farthest;
}

}  // namespace twinarm
