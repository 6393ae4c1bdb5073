#include "solver/integration/implicit_integrators.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/linear_algebra/nan_max.h"
#include "solver/model/configuration.h"

namespace twinarm {
namespace {

constexpr int kMaxIterations = 60;
constexpr double kDifference = 1e-7;  // relative velocity difference for the Jacobian
constexpr double kRounding = 4e-16;   // relative correction that ends the iteration
constexpr double kAtRounding =
    1e-9;  // relative: stalled corrections below this are rounding of ABA

double largest(const std::vector<double>& v) {
  double size = 0;
  for (const double x : v) size = nan_max(size, std::abs(x));
  return size;
}

}  // namespace

void DenseLu::factorise() {
  DenseLu& A = *this;
  for (std::size_t k = 0; k < n_; ++k) {
    std::size_t p = k;
    for (std::size_t i = k + 1; i < n_; ++i)
      if (std::abs(A(i, k)) > std::abs(A(p, k))) p = i;
    pivot_[k] = p;
    if (p != k)
      for (std::size_t j = 0; j < n_; ++j) std::swap(A(k, j), A(p, j));
    for (std::size_t i = k + 1; i < n_; ++i) {
      const double l = A(i, k) /= A(k, k);
      for (std::size_t j = k + 1; j < n_; ++j) A(i, j) -= l * A(k, j);
    }
  }
}

void DenseLu::solve(std::vector<double>& b) const {
  for (std::size_t k = 0; k < n_; ++k) std::swap(b[k], b[pivot_[k]]);
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j < i; ++j) b[i] -= A_[i * n_ + j] * b[j];
  for (std::size_t i = n_; i-- > 0;) {
    for (std::size_t j = i + 1; j < n_; ++j) b[i] -= A_[i * n_ + j] * b[j];
    b[i] /= A_[i * n_ + i];
  }
}

ImplicitStep::ImplicitStep(std::size_t nv)
    : u_(nv), r_(nv), known_(nv), delta_(nv), trial_(nv), r_trial_(nv), du_(nv), lu_(nv) {}

void ImplicitStep::step(IntegrationState& m, Integrator integrator, double h, StepReport& report) {
  prepare(m, integrator, h);
  report.converged = iterate(m, report);
  finish(m, integrator, h);
}

void ImplicitStep::prepare(IntegrationState& m, Integrator integrator, double h) {
  weight_u_ = integrator == Integrator::implicit_euler ? h : h / 2;
  weight_v_ = integrator == Integrator::trapezoid ? h / 2 : 0;
  t_u_ = m.x.t + (integrator == Integrator::implicit_midpoint ? h / 2 : h);
  u_ = m.x.qd;
  known_ = m.x.qd;
  m.prepare_projection();
  if (integrator != Integrator::trapezoid) return;
  m.accelerate();
  for (std::size_t i = 0; i < known_.size(); ++i) known_[i] += h / 2 * m.w.qdd[i];
}

double ImplicitStep::residual(IntegrationState& m, const std::vector<double>& u,
                              std::vector<double>& r) {
  for (std::size_t i = 0; i < u.size(); ++i) delta_[i] = weight_u_ * u[i] + weight_v_ * m.x.qd[i];
  integrate_coordinates(m.model(), m.x.q, delta_, m.stage.q);
  m.stage.qd = u;
  m.stage.t = t_u_;
  m.accelerate_stage();
  for (std::size_t i = 0; i < u.size(); ++i) r[i] = u[i] - known_[i] - weight_u_ * m.w.qdd[i];
  return largest(r);
}

void ImplicitStep::form_jacobian(IntegrationState& m) {
  const std::size_t n = u_.size();
  trial_ = u_;
  for (std::size_t j = 0; j < n; ++j) {
    trial_[j] = u_[j] + kDifference * (1 + std::abs(u_[j]));
    residual(m, trial_, r_trial_);
    for (std::size_t i = 0; i < n; ++i) lu_(i, j) = (r_trial_[i] - r_[i]) / (trial_[j] - u_[j]);
    trial_[j] = u_[j];
  }
  lu_.factorise();
}

// Simplified Newton iteration. `before`: size of the last correction with the same Jacobian; if the
// next one is not much smaller, rounding is reached or the Jacobian is outdated.
bool ImplicitStep::iterate(IntegrationState& m, StepReport& report) {
  double size = residual(m, u_, r_), before = 0;
  for (int n = 0; size != 0; ++n) {
    if (n == kMaxIterations) return false;
    if (!std::isfinite(size)) {  // makes the state non-finite, so that it is reported
      for (std::size_t i = 0; i < u_.size(); ++i) u_[i] -= r_[i];
      return false;
    }
    ++report.iterations;
    if (before == 0) form_jacobian(m);
    du_ = r_;
    lu_.solve(du_);
    const double step = largest(du_), scale = std::max(largest(u_), largest(known_));
    const bool slow = before > 0 && !(step < 0.3 * before);
    const bool rounding = step <= (slow ? kAtRounding : kRounding) * scale;
    if (slow && !rounding) {
      before = 0;
      continue;
    }
    size = line_search(m, size, step, scale);
    if (rounding) return true;
    before = step;
  }
  return true;
}

// Backtracking until |r| does not increase; updates u_ and r_, returns |r|.
double ImplicitStep::line_search(IntegrationState& m, double size, double step, double scale) {
  double new_size = size;
  double factor = 1;
  for (int tries = 0; tries < 10; ++tries, factor /= 2) {
    for (std::size_t i = 0; i < u_.size(); ++i) trial_[i] = u_[i] - factor * du_[i];
    new_size = residual(m, trial_, r_trial_);
    if (new_size <= size || step <= kAtRounding * scale) break;
  }
  std::swap(u_, trial_);
  std::swap(r_, r_trial_);
  return new_size;
}

void ImplicitStep::finish(IntegrationState& m, Integrator integrator, double h) {
  const bool midpoint = integrator == Integrator::implicit_midpoint;
  for (std::size_t i = 0; i < u_.size(); ++i) {
    delta_[i] = midpoint ? h * u_[i] : weight_u_ * u_[i] + weight_v_ * m.x.qd[i];
    m.x.qd[i] = midpoint ? 2 * u_[i] - m.x.qd[i] : u_[i];
  }
  integrate_coordinates(m.model(), m.x.q, delta_, m.x.q);
}

}  // namespace twinarm
