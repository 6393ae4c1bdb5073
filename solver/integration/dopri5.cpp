#include "solver/integration/dopri5.h"

#include <utility>

#include "solver/linear_algebra/nan_max.h"
#include "solver/model/configuration.h"

namespace twinarm {
namespace {

constexpr Tableau::Row<double> kErrorWeights{
    71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
constexpr int kMaxAttempts = 10'000'000;  // per step

}  // namespace

Dopri5::Dopri5(const IntegrationState& m)
    : rk_(m.model().nv),
      margin_(m.dynamics.groups().size()),
      size_(m.model().nv),
      size_new_(m.model().nv) {}

void Dopri5::step(IntegrationState& m, double h, bool one, StepReport& report) {
  const double t_end = m.x.t + h;
  report.substeps = 0;
  m.accelerate();
  rk_.first_stage(m);
  rejected_ = false;
  if (h_next_ == 0) h_next_ = first_substep(m, h);
  while (m.x.t < t_end) {
    const bool last = m.x.t + 1.001 * h_next_ >= t_end;  // avoids a tiny remainder step
    const double h_try = last ? t_end - m.x.t : h_next_;
    const bool shortest = m.x.t + 0.1 * h_try == m.x.t;
    if (m.dynamics.has_coulomb()) margin_.start(m);
    stages(m, h_try);
    err_ = error(m, h_try);
    if (err_ <= 1) {
      const double h_done = up_to_event(m, h_try, report);
      if (h_done == h_try) choose_next(h_try, !last);
      accept(m, last && h_done == h_try ? t_end : m.x.t + h_done);
      ++report.substeps;
      if (one) return;
      continue;
    }
    ++report.rejected;
    if (shortest || report.substeps + report.rejected >= kMaxAttempts) {
      report.reached = false;
      if (!std::isfinite(err_)) {  // return the non-finite state, so that it is reported
        std::swap(m.x, m.stage);
        std::swap(m.x.t, m.stage.t);
      }
      return;
    }
    choose_next(h_try, true);
  }
}

// Size of the substep up to the first friction event, at most h; sets m.stage accordingly.
double Dopri5::up_to_event(IntegrationState& m, double h, StepReport& report) {
  if (!m.dynamics.has_coulomb()) return h;
  const auto margin = [&](double s) {
    stages(m, s);
    return margin_(m.dynamics, m.stage);
  };
  const double g_end = margin_(m.dynamics, m.stage);
  if (!(g_end < 0 && margin_.at_start() > 0)) return h;
  const double h_event = locate_zero(h, margin_.at_start(), g_end, margin);
  if (m.x.t + h_event > m.x.t) {
    ++report.events;
    return h_event;
  }
  stages(m, h);  // event too close to the start for a substep
  return h;
}

// Afterwards m.w contains the acceleration at the new m.x, the first stage of the next substep.
void Dopri5::accept(IntegrationState& m, double t) {
  std::swap(m.x, m.stage);
  m.x.t = t;
  if (m.dynamics.has_coulomb()) {
    m.dynamics.zero_sticking_velocities(m.x);
    m.project_and_update();
    m.accelerate();
  } else {
    m.start_projection();
  }
  rk_.first_stage(m);
}

double Dopri5::error(const IntegrationState& m, double h) {
  const int stages = Tableau::kMaxStages;
  coordinate_sizes(m.model(), m.x.q, size_);
  coordinate_sizes(m.model(), m.stage.q, size_new_);
  double err = 0;
  for (std::size_t i = 0; i < size_.size(); ++i) {
    const double error_q = h * rk_.rate_sum(kErrorWeights, stages, i);
    const double error_qd = h * rk_.qdd_sum(kErrorWeights, stages, i);
    err = nan_max(err, scaled(error_q, size_[i], size_new_[i]));
    err = nan_max(err, scaled(error_qd, m.x.qd[i], m.stage.qd[i]));
    if (!m.has_loops()) continue;  // the projection of the last stage is part of the error
    err = nan_max(err, scaled(m.projection.correction_q()[i], size_[i], size_new_[i]));
    err = nan_max(err, scaled(m.projection.correction_qd()[i], m.x.qd[i], m.stage.qd[i]));
  }
  return err;
}

// Step-size control after an attempt with h; `full`: h was not shortened to the end of the step.
void Dopri5::choose_next(double h, bool full) {
  if (!(err_ <= 1)) {
    const double factor = std::isfinite(err_) ? std::max(0.2, 0.9 * std::pow(err_, -0.2)) : 0.1;
    h_next_ = h * factor;
    rejected_ = true;
    return;
  }
  const double err = std::max(err_, 1e-8);
  double factor = 0.9 * std::pow(err, -0.17) * std::pow(err_before_, 0.04);
  factor = std::clamp(factor, 0.2, rejected_ ? 1.0 : 10.0);  // no growth after a rejection
  h_next_ = full ? h * factor : std::max(h_next_, h * factor);
  err_before_ = std::max(err, 1e-4);
  rejected_ = false;
}

// Starting step size, Hairer, Norsett, Wanner, II.4: from the state, its derivative and a
// difference estimate of the second derivative.
double Dopri5::first_substep(IntegrationState& m, double h_max) {
  const Tableau& euler = tableau_of(Integrator::euler);
  coordinate_sizes(m.model(), m.x.q, size_);
  double d0 = 0, d1 = 0, d2 = 0;
  for (std::size_t i = 0; i < size_.size(); ++i) {
    const double v = m.x.qd[i], a = rk_.qdd_sum(euler.b, 1, i);
    d0 = nan_max(d0, std::max(scaled(size_[i], size_[i], 0), scaled(v, v, 0)));
    d1 = nan_max(d1, nan_max(scaled(v, size_[i], 0), scaled(a, v, 0)));
  }
  const double h0 = std::min(h_max, d0 < 1e-5 || !(d1 > 1e-5) ? 1e-6 : 0.01 * d0 / d1);
  rk_.stage(m, tableau_of(Integrator::heun), 1, h0);
  const Tableau::Row<double> second{-1 / h0, 1 / h0};
  for (std::size_t i = 0; i < size_.size(); ++i) {
    d2 = nan_max(d2, scaled(rk_.rate_sum(second, 2, i), size_[i], 0));
    d2 = nan_max(d2, scaled(rk_.qdd_sum(second, 2, i), m.x.qd[i], 0));
  }
  const double d = std::max(d1, d2);
  const double h1 = d > 1e-15 ? std::pow(0.01 / d, 0.2) : std::max(1e-6, 1e-3 * h0);
  return std::isfinite(d) ? std::min({h_max, 100 * h0, h1}) : h_max;
}

}  // namespace twinarm
