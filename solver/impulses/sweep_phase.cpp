// Budget of impulse_solver.h, and its phase of sweeps.
#include <algorithm>

#include "solver/impulses/impulse_solver.h"

namespace twinarm {
namespace {

constexpr double kSweepsToNewton = 1e-6;  // change in a sweep before Newton steps are tried [m/s]

}  // namespace

// Without what is done once for an island.
void ImpulseSolver::count_work() {
  work_ = newton_work_ = sweep_work_ = 0;
  for (const int t : order_) {
    const auto n = static_cast<double>(problem_->size(t));
    const double width = static_cast<double>(row_[t] - row_[lowest_[t]]) + 0.5 * n;
    newton_work_ += 2 * n * width * width;
  }
  for (const int i : island_->constraints) {
    double n = 0;  // velocities
    for (const int t : constraint(i).tree)
      n += t == ImpulseConstraint::no_tree ? 0 : problem_->size(t);
    sweep_work_ += 100 + 4 * constraint(i).rows * n;
    newton_work_ += 2 * constraint(i).rows * n * (n + 3);
  }
}

bool ImpulseSolver::is_exact() const {
  return accepted < kSweepsToNewton;
}

// From p of the constraints.
void ImpulseSolver::run_sweeps(double max_sweeps, ImpulseReport& report) {
  sweeps_.start(*problem_, {island_->trees, island_->constraints, factors_, rho0_});
  bool try_newton = is_exact();
  int sweeps = 0;
  for (; sweeps < max_sweeps && has_budget() && best_ > accepted; ++sweeps) {
    const double change = sweeps_.sweep();
    work_ += sweep_work_;
    const bool ends = try_newton && change <= kSweepsToNewton && has_budget(2 * newton_work_);
    if (!ends && change > accepted) continue;
    keep_best(apply_impulses());
    if (!ends || best_ <= accepted) continue;
    try_newton = false;
    for (const int i : island_->constraints) swept_p_[i] = constraint(i).p;
    keep_best(warm_start_newton(report));
    if (best_ > accepted) apply_impulses(swept_p_);
  }
  report.sweeps = std::max(report.sweeps, sweeps);
  if (best_ > accepted) keep_best(apply_impulses());
}

// At the end of the budget: scales the impulses so that they do not increase the energy,
//   p . J v0 + 1/2 p . J M^-1 J^T p <= 0;
// the exact solution does not, unless a support moves. Returns the residual.
double ImpulseSolver::scale_impulses() {
  double linear = 0, quadratic = 0;
  for (const int i : island_->constraints) {
    const ImpulseConstraint& c = constraint(i);
    if (c.b[0] < 0 || c.b[1] != 0 || c.b[2] != 0) return apply_impulses();
    for (int r = 0; r < c.rows; ++r) quadratic += c.p[r] * (c.u[r] - c.b[r]);
    Vec u0;
    problem_->velocity(c, problem_->v0(0), u0);
    linear += cone_dot(c.p, u0);
  }
  quadratic -= linear;  // p . J (v - v0)
  if (!(linear + 0.5 * quadratic > 0)) return apply_impulses();
  const double scale = std::max(0.0, -2 * linear / quadratic);
  for (const int i : island_->constraints)
    for (double& p : constraint(i).p) p *= scale;
  return apply_impulses();
}

}  // namespace twinarm
