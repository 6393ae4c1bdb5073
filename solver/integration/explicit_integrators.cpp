#include "solver/integration/explicit_integrators.h"

#include "solver/model/configuration.h"

namespace twinarm {
namespace {

constexpr Tableau kEuler{1, {0}, {1}, {}};
constexpr Tableau kMidpoint{2, {0, 0.5}, {0, 1}, {{{}, {0.5}}}};
constexpr Tableau kHeun{2, {0, 1}, {0.5, 0.5}, {{{}, {1}}}};
constexpr Tableau kRk4{
    4, {0, 0.5, 0.5, 1}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}, {{{}, {0.5}, {0, 0.5}, {0, 0, 1}}}};
// Dormand and Prince 1980; Hairer, Norsett, Wanner, Solving ODEs I, table II.5.2. First same as
// last.
constexpr Tableau kDopri5{
    7,
    {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1},
    {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84, 0},
    {{{},
      {1.0 / 5},
      {3.0 / 40, 9.0 / 40},
      {44.0 / 45, -56.0 / 15, 32.0 / 9},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
      {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}}}};

double weighted_sum(const Tableau::Row<std::vector<double>>& of, const Tableau::Row<double>& weight,
                    int stages, std::size_t i) {
  double sum = 0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(stages); ++j)
    if (weight[j] != 0) sum += weight[j] * of[j][i];
  return sum;
}

}  // namespace

const Tableau& tableau_of(Integrator integrator) {
  switch (integrator) {
    case Integrator::midpoint:
      return kMidpoint;
    case Integrator::heun:
      return kHeun;
    case Integrator::rk4:
      return kRk4;
    case Integrator::dopri5:
      return kDopri5;
    default:
      return kEuler;
  }
}

double RungeKutta::rate_sum(const Tableau::Row<double>& weight, int stages, std::size_t i) const {
  return weighted_sum(rate_, weight, stages, i);
}

double RungeKutta::qdd_sum(const Tableau::Row<double>& weight, int stages, std::size_t i) const {
  return weighted_sum(qdd_, weight, stages, i);
}

void RungeKutta::stage(IntegrationState& m, const Tableau& tableau, int s, double h) {
  const auto row = static_cast<std::size_t>(s);
  for (std::size_t i = 0; i < theta_.size(); ++i) {
    theta_[i] = h * rate_sum(tableau.a[row], s, i);
    m.stage.qd[i] = m.x.qd[i] + h * qdd_sum(tableau.a[row], s, i);
  }
  integrate_coordinates(m.model(), m.x.q, theta_, m.stage.q);
  m.stage.t = m.x.t + tableau.c[row] * h;
  m.accelerate_stage();
  tangent_rate(m.model(), theta_, m.stage.qd, rate_[row]);
  qdd_[row] = m.w.qdd;
}

void RungeKutta::step(IntegrationState& m, const Tableau& tableau, double h) {
  m.accelerate();
  first_stage(m);
  for (int s = 1; s < tableau.stages; ++s) stage(m, tableau, s, h);
  for (std::size_t i = 0; i < theta_.size(); ++i) {
    theta_[i] = h * rate_sum(tableau.b, tableau.stages, i);
    m.x.qd[i] += h * qdd_sum(tableau.b, tableau.stages, i);
  }
  integrate_coordinates(m.model(), m.x.q, theta_, m.x.q);
}

void kick(IntegrationState& m, double h) {
  for (std::size_t i = 0; i < m.model().nv; ++i) m.x.qd[i] += h * m.w.qdd[i];
}

void drift(IntegrationState& m, std::vector<double>& delta, double h) {
  for (std::size_t i = 0; i < m.model().nv; ++i) delta[i] = h * m.x.qd[i];
  integrate_coordinates(m.model(), m.x.q, delta, m.x.q);
}

void step_verlet(IntegrationState& m, std::vector<double>& delta, double h) {
  m.accelerate();
  kick(m, h / 2);
  drift(m, delta, h);
  m.stage.q = m.x.q;
  m.stage.t = m.x.t + h;
  for (std::size_t i = 0; i < m.model().nv; ++i)
    m.stage.qd[i] = m.x.qd[i] + h / 2 * m.w.qdd[i];  // predicted velocity v + h a
  m.accelerate_stage();
  kick(m, h / 2);
}

}  // namespace twinarm
