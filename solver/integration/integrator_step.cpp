#include "solver/integration/integrator_step.h"

#include <cmath>
#include <stdexcept>

#include "solver/model/configuration.h"
#include "solver/model/mimic.h"
#include "solver/model/non_finite.h"

namespace twinarm {

IntegratorStep::IntegratorStep(const IntegrationState& m)
    : delta_(m.model().nv), rk_(m.model().nv), dopri5_(m), events_(m) {}

void IntegratorStep::set_integrator(Integrator integrator, double tolerance) {
  if (!(tolerance > 0) || !std::isfinite(tolerance))
    throw std::invalid_argument("tolerance must be positive and finite");
  integrator_ = integrator;
  dopri5_.set_tolerance(tolerance);
  reset_step_size();
  if (facts_of(integrator).solves && !implicit_) implicit_.emplace(delta_.size());
}

void IntegratorStep::step(IntegrationState& m, double h, bool one_substep, StepReport& report) {
  const double t = m.x.t;
  if (integrator_ == Integrator::semi_implicit_xv) {  // forces at the new coordinates
    m.prepare_projection();
    drift(m, delta_, h);
    m.x.t = t + h;
    m.project_and_update();
    if (m.account) m.account->add_projection();
  }
  m.begin_step(h);
  if (integrator_ == Integrator::dopri5) return dopri5_.step(m, h, one_substep, report);
  if (facts_of(integrator_).implicit_force) {
    m.accelerate_over(h);
    kick(m, h);
    m.dynamics.zero_sticking_velocities(m.x);
    apply_mimics(m.model(), m.x);
    if (integrator_ == Integrator::semi_implicit) drift(m, delta_, h);
  } else if (m.dynamics.has_coulomb()) {
    report.events = events_.advance(m, h, [&](double s) { smooth_step(m, s, report); });
  } else {
    smooth_step(m, h, report);
  }
  m.x.t = t + h;
}

void IntegratorStep::smooth_step(IntegrationState& m, double h, StepReport& report) {
  if (facts_of(integrator_).solves)
    implicit_->step(m, integrator_, h, report);
  else if (integrator_ == Integrator::verlet)
    step_verlet(m, delta_, h);
  else
    rk_.step(m, tableau_of(integrator_), h);
}

void report_non_finite(const IntegrationState& m, StepReport& report) {
  double sum = 0;  // one non-finite number makes the sum non-finite
  for (const auto* numbers : {&m.x.q, &m.x.qd, &m.x.prescribed})
    for (double number : *numbers) sum += number * 0;
  if (sum == 0) return;

  report.finite = false;
  const NonFiniteField bad = first_bad_quantity(m.model(), m.forces, m.w);
  if (bad.body != 0) {
    report.nonfinite_field = bad.name;
    report.nonfinite_body = static_cast<int>(bad.body);
    return;
  }
  const std::vector<double> q = q_with_prescribed(m.model(), m.x);
  const auto bad_q = std::ranges::find_if_not(q, [](double c) { return std::isfinite(c); });
  if (bad_q == q.end()) return;
  report.nonfinite_field = "q";
  for (std::size_t i = 1; i < m.model().parent.size(); ++i)
    if (m.model().iq[i] + m.model().ip[i] <= static_cast<std::size_t>(bad_q - q.begin()))
      report.nonfinite_body = static_cast<int>(i);
}

}  // namespace twinarm
