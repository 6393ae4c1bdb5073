#include "solver/simulation.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "solver/aba.h"
#include "solver/slice.h"

namespace twinarm {
namespace {

void check(const ForceSource& source, Integrator integrator) {
  if (integrator != Integrator::semi_implicit && source.needs_semi_implicit())
    throw std::invalid_argument(
        "implicit spring-dampers go with the semi-implicit integrator only");
}

}  // namespace

Simulation::Simulation(const Model<double>& model, State<double> start)
    : model_(model),
      x_(std::move(start)),
      stage_(x_),
      k_(model),
      k_stage_(model),
      w_(model),
      forces_(model),
      theta_(model.nv),
      rate_(model.nv),
      theta_sum_(model.nv),
      qdd_sum_(model.nv) {
  forward_kinematics(model_, x_, k_);
}

void Simulation::add(ForceSource& source) {
  check(source, integrator_);
  sources_.push_back(&source);
}

void Simulation::set_integrator(Integrator integrator) {
  for (const ForceSource* source : sources_) check(*source, integrator);
  integrator_ = integrator;
}

StepReport Simulation::step(double h) noexcept {
  for (ForceSource* source : sources_) source->begin_step(k_, x_.t, h);
  int rounds = 1;
  switch (integrator_) {
    case Integrator::euler:
    case Integrator::semi_implicit:
      rounds = step_euler(h);
      break;
    case Integrator::rk4:
      step_rk4(h);
      break;
  }
  x_.t += h;
  forward_kinematics(model_, x_, k_);
  return report(rounds);
}

void Simulation::accelerations(const State<double>& x, const Kinematics& k) {
  forces_.clear();
  for (ForceSource* source : sources_) source->add_forces(x, k, forces_);
  aba(model_, x, forces_, w_);
}

int Simulation::step_euler(double h) {
  int rounds = 0;
  for (bool again = true; again && rounds < ForceSource::kMaxRounds; ++rounds) {
    accelerations(x_, k_);
    again = false;
    for (ForceSource* source : sources_) again = source->refine(k_, w_) || again;
  }
  for (std::size_t i = 0; i < model_.nv; ++i) {
    const double qd_before = x_.qd[i];
    x_.qd[i] += h * w_.qdd[i];
    theta_[i] = h * (integrator_ == Integrator::euler ? qd_before : x_.qd[i]);
  }
  integrate_coordinates(model_, x_.q, theta_, x_.q);
  return rounds;
}

void Simulation::step_rk4(double h) {
  constexpr double c[4] = {0, 0.5, 0.5, 1}, b[4] = {1, 2, 2, 1};
  theta_sum_.assign(model_.nv, 0.0);
  qdd_sum_.assign(model_.nv, 0.0);
  for (int s = 0; s < 4; ++s) {
    for (std::size_t i = 0; i < model_.nv; ++i) {
      theta_[i] = s == 0 ? 0 : h * c[s] * rate_[i];
      stage_.qd[i] = x_.qd[i] + (s == 0 ? 0 : h * c[s] * w_.qdd[i]);
    }
    integrate_coordinates(model_, x_.q, theta_, stage_.q);
    stage_.t = x_.t + c[s] * h;
    forward_kinematics(model_, stage_, k_stage_);
    accelerations(stage_, k_stage_);
    shift_rate(model_, theta_, stage_.qd, rate_);
    for (std::size_t i = 0; i < model_.nv; ++i) {
      theta_sum_[i] += b[s] / 6 * h * rate_[i];
      qdd_sum_[i] += b[s] / 6 * h * w_.qdd[i];
    }
  }
  for (std::size_t i = 0; i < model_.nv; ++i) x_.qd[i] += qdd_sum_[i];
  integrate_coordinates(model_, x_.q, theta_sum_, x_.q);
}

StepReport Simulation::report(int rounds) const {
  StepReport report;
  report.rounds = rounds;
  double sum = 0;  // one non-finite number makes the sum non-finite
  for (double q : x_.q) sum += q * 0;
  for (double qd : x_.qd) sum += qd * 0;
  if (sum == 0) return report;

  report.finite = false;
  const auto bad = [](const Vec3<double>& v) { return !(v.x * 0 + v.y * 0 + v.z * 0 == 0); };
  const std::size_t n = model_.parent.size();
  const auto look = [&](const char* field, bool from_tips, auto is_bad) {
    for (std::size_t step = 1; step < n && !report.bad_field; ++step) {
      const std::size_t i = from_tips ? n - step : step;
      if (!is_bad(i)) continue;
      report.bad_field = field;
      report.bad_body = static_cast<int>(i);
    }
  };
  look("tau", false, [&](std::size_t i) {
    bool any = false;
    visit_joint<double>(model_.joint[i], [&](auto joint) {
      for (double tau : slice<joint.nv>(forces_.tau, model_.iv[i])) any = any || tau * 0 != 0;
    });
    return any;
  });
  look("f_ext", false,
       [&](std::size_t i) { return bad(forces_.f_ext[i].n) || bad(forces_.f_ext[i].f); });
  look("v", false, [&](std::size_t i) { return bad(w_.v[i].w) || bad(w_.v[i].v); });
  look("c", false, [&](std::size_t i) { return bad(w_.c[i].w) || bad(w_.c[i].v); });
  look("pA", true, [&](std::size_t i) { return bad(w_.pA[i].n) || bad(w_.pA[i].f); });
  look("a", false, [&](std::size_t i) { return bad(w_.a[i].w) || bad(w_.a[i].v); });
  look("q", false, [&](std::size_t i) {
    return model_.iq[i] < model_.nq && !std::isfinite(x_.q[model_.iq[i]]);
  });
  return report;
}

}  // namespace twinarm
