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
#include <limits>

#include "solver/impulses/impulse_solver.h"
#include "solver/impulses/ipm_equations.h"

namespace twinarm {
namespace {

constexpr double poor_step = 0.5, stuck_step = 0.05, min_centering = 0.1;
constexpr int max_iterations = 60, max_stuck = 3;

}  // namespace

int ImpulseSolver::interior_point_start(ImpulseProblem& problem, const Island& island) {
  begin_centrally(problem, island, 0);
  shift_part_ = 1, rounded_ = 0;
  double step = 1, best = std::numeric_limits<double>::infinity();
  int iterations = 0, stuck = 0;
  for (; iterations < max_iterations && stuck <= max_stuck; ++iterations) {
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
    for (const int i : cones_)
      for (int r = 0; r < 3; ++r)
        after += (x_[i][r] + affine * dx_[i][r]) * (z_[i][r] + affine * dz_[i][r]);
    const double ratio = std::max(0.0, after / (mean * static_cast<double>(cones_.size())));
    double centering = std::clamp(ratio * ratio * ratio, min_centering, 1.0);
    const bool correct = step >= poor_step;  // after a poor step back to the middle first
    if (!correct) centering = std::max(centering, 0.3);
    step = std::min(1.0, 0.99 * direct_centrally(problem, island, centering * mean, correct));
    stuck += step < stuck_step;
    move_centrally(problem, island, step);
  }
  for (const int i : island.constraints) problem.constraints()[i].p = kept_[i];
  return iterations;
}

// dv_, dx_ and dz_ towards x o z = s e; the corrector is that of the direction before. Returns how
// far the cones let go.
double ImpulseSolver::direct_centrally(ImpulseProblem& problem, const Island& island, double s,
                                       bool correct) {
  for (const int i : cones_) {
    const ConeScaling& scaling = scaling_[i];
    const Vec square = jordan(scaling.t, scaling.t);
    right_[i] = {s * terms_[i].weight - square[0], -square[1], -square[2]};
    if (!correct) continue;
    const Vec Wdz = times(scaling.W, dz_[i]);
    const Vec Wdx{-scaling.t[0] - Wdz[0], -scaling.t[1] - Wdz[1], -scaling.t[2] - Wdz[2]};
    const Vec second = jordan(Wdz, Wdx);
    for (int r = 0; r < 3; ++r) right_[i][r] -= second[r];
  }
  solve_centrally(problem, island, r_z_, 1);
  double farthest = std::numeric_limits<double>::infinity();
  for (const int i : cones_)
    farthest = std::min({farthest, cone_step(x_[i], dx_[i]), cone_step(z_[i], dz_[i])});
  return farthest;
}

void ImpulseSolver::move_centrally(ImpulseProblem& problem, const Island& island, double step) {
  for (const int i : cones_)
    for (int r = 0; r < 3; ++r) x_[i][r] += step * dx_[i][r], z_[i][r] += step * dz_[i][r];
  move(problem, island, step);
}

}  // namespace twinarm
