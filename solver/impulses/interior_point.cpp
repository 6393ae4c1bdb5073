// Start of the iterations of island_solver.h if the active set changes much: primal-dual
// interior-point method on the exact laws with de Saxce shift (after Acary, Armand, Nguyen and
// Shpakovych 2023).
//
// For each contact, with T = diag(1/mu, 1, 1):  z = T (u + mu |u_t| e_n),  p = T x,
//   x, z in Q,  x o z = s e,  s -> 0,
// linearised in the Nesterov-Todd scaling W z = W^-1 x = t:
//   dx = W (t \ (s e - t o t - corrector)) - W^2 dz,    dz = T E J dv + r_z,
// E = 1 + e_n (0, mu u_t / |u_t|): one nonsymmetric system in the velocities,
//   (M + J^T T W^2 T E J) dv = ...
// 10 to 30 iterations from any start, also with redundant contacts; the impulses end in the
// interior of the solution set, a good initial guess of the next step. Constraints that are not
// contacts use impulse_law.h, with a multiplier update per iteration.
#include <limits>

#include "solver/impulses/interior_phase.h"

namespace twinarm {
namespace {

constexpr double kPoorStep = 0.5, kStuckStep = 0.05, kMinCentering = 0.1;
constexpr int kMaxIterations = 60, kMaxStuck = 3;

}  // namespace

int InteriorPhase::solve() {
  initialize(0);
  shift_factor_ = 1, smoothing_ = 0;
  double step = 1, best = std::numeric_limits<double>::infinity();
  int iterations = 0, stuck = 0;
  for (; iterations < kMaxIterations && stuck <= kMaxStuck && island_.has_budget(); ++iterations) {
    double residual = 0;
    const double mean = evaluate(residual);
    if (!(mean > 0) || !(residual < 1e100)) break;
    if (residual < best) {
      best = residual;
      for (const int i : island_.constraints()) kept_[i] = island_.p[i];
    }
    if (residual <= island_.wanted.tolerance) break;
    if (!matrix_.factorise(false)) break;
    const double affine = std::min(1.0, find_direction(0, false));
    double after = 0;
    for (const int i : cones_)
      for (int r = 0; r < 3; ++r)
        after += (x_[i][r] + affine * dx_[i][r]) * (z_[i][r] + affine * dz_[i][r]);
    const double ratio = std::max(0.0, after / (mean * static_cast<double>(cones_.size())));
    double centering = std::clamp(ratio * ratio * ratio, kMinCentering, 1.0);
    const bool correct = step >= kPoorStep;  // after a poor step: centering without corrector
    if (!correct) centering = std::max(centering, 0.3);
    step = std::min(1.0, 0.99 * find_direction(centering * mean, correct));
    stuck += step < kStuckStep;
    update(step);
  }
  for (const int i : island_.constraints()) island_.constraint(i).p = kept_[i];
  return iterations;
}

// Direction dv_, dx_, dz_ towards x o z = s e, with Mehrotra's corrector from the previous
// direction if `correct`. Returns the maximum step within the cones.
double InteriorPhase::find_direction(double s, bool correct) {
  for (const int i : cones_) {
    const ConeScaling& scaling = scaling_[i];
    const Vec square = jordan(scaling.t, scaling.t);
    right_[i] = {s - square[0], -square[1], -square[2]};
    if (!correct) continue;
    const Vec Wdz = times(scaling.W, dz_[i]);
    const Vec Wdx{-scaling.t[0] - Wdz[0], -scaling.t[1] - Wdz[1], -scaling.t[2] - Wdz[2]};
    const Vec second = jordan(Wdz, Wdx);
    for (int r = 0; r < 3; ++r) right_[i][r] -= second[r];
  }
  solve_kkt(r_z_, 1);
  double max_step = std::numeric_limits<double>::infinity();
  for (const int i : cones_)
    max_step = std::min({max_step, cone_step(x_[i], dx_[i]), cone_step(z_[i], dz_[i])});
  return max_step;
}

void InteriorPhase::update(double step) {
  for (const int i : cones_)
    for (int r = 0; r < 3; ++r) x_[i][r] += step * dx_[i][r], z_[i][r] += step * dz_[i][r];
  island_.move(step);
}

}  // namespace twinarm
