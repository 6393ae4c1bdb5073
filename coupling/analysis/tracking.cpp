#include "coupling/analysis/tracking.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/analysis/joint_space_stiffness.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

TrackingError tracking_error(const TrackingSeries& series) {
  TrackingError error;
  const std::size_t n = series.t.size();
  for (std::size_t j = 0; j < series.q_K.size(); ++j) {
    double max_error = 0, integral = 0, before = 0;
    for (std::size_t s = 0; s < n; ++s) {
      const double e = std::abs(series.q_K[j][s] - series.q_D[j][s]);
      max_error = std::max(max_error, e);
      if (s > 0) integral += 0.5 * (e + before) * (series.t[s] - series.t[s - 1]);
      before = e;
    }
    error.max.push_back(max_error);
    error.mean.push_back(n > 1 ? integral / (series.t.back() - series.t.front()) : 0.0);
  }
  return error;
}

TrackingSystem::TrackingSystem(const TrackingSetup& setup) : setup_(setup) {
  check_step_size(setup.h);
  kvr_ = std::make_unique<TargetRobot>(*setup.kvr_model, *setup.motion, setup.mapping, setup.joints,
                                       setup.kvr_rates);
  State<double> start(*setup.dvr_model);
  start.q = kvr_->start().x.q;  // at rest at the KVR's pose
  simulation_ = std::make_unique<Simulation>(*setup.dvr_model, start);
  for (const CouplingSpec& spec : setup.couplings) {
    couplings_.push_back(make_coupling(spec, *setup.dvr_model, *kvr_));
    simulation_->add(*couplings_.back());
  }
  simulation_->set_integrator(setup.integrator);
  for (const std::string& name : setup.joints.turned)
    iq_.push_back(setup.dvr_model->iq[static_cast<std::size_t>(setup.dvr_model->find_joint(name))]);
}

void TrackingSystem::record(TrackingSeries& series) {
  const State<double>& x = simulation_->state();
  series.t.push_back(x.t);
  for (std::size_t j = 0; j < iq_.size(); ++j) {
    series.q_K[j].push_back(kvr_->at(x.t).x.q[iq_[j]]);
    series.q_D[j].push_back(x.q[iq_[j]]);
  }
  for (std::size_t s = 0; s < series.coupling_force.size(); ++s)
    series.coupling_force[s].push_back(couplings_.front()->readings()[s].size);
}

TrackingSeries TrackingSystem::run(const std::function<void(double)>& each_step) {
  constexpr double kDiverged = 1e3;  // [rad]
  TrackingSeries series;
  series.q_K.resize(iq_.size());
  series.q_D.resize(iq_.size());
  series.coupling_force.resize(couplings_.empty() ? 0 : couplings_.front()->springs().size());
  const auto steps = static_cast<std::size_t>(std::lround(setup_.motion->duration() / setup_.h));
  const auto sample = [&] {
    record(series);
    if (each_step) each_step(simulation_->state().t);
  };
  sample();
  for (std::size_t n = 0; n < steps; ++n) {
    const StepReport report = simulation_->step(setup_.h);
    const auto& q = simulation_->state().q;
    const bool bounded =
        std::ranges::all_of(iq_, [&](std::size_t iq) { return std::abs(q[iq]) < kDiverged; });
    if (!report.finite || !bounded) {
      series.finite = false;
      break;
    }
    sample();
  }
  return series;
}

using Eigen::MatrixXd;
using Eigen::VectorXd;

JumpErrors response_to_velocity_steps(const MatrixXd& M, const MatrixXd& K, const MatrixXd& B,
                                      const std::vector<VelocityStep>& jumps, double duration) {
  const Eigen::Index n = M.rows();
  const MatrixXd inverse = inverse_of(M), I = MatrixXd::Identity(2 * n, 2 * n);
  MatrixXd A = MatrixXd::Zero(2 * n, 2 * n);  // of x = (e, v)
  A.topRightCorner(n, n).setIdentity();
  A.bottomRows(n) << -inverse * K, -inverse * B;
  const double max_omega = std::sqrt(std::max(0.0, squared_frequencies(M, K).maxCoeff()));
  const double max_damping = squared_frequencies(M, B).maxCoeff();
  const double max_step = std::min(duration / 100, 0.02 / std::max(max_omega, max_damping));
  VectorXd x = VectorXd::Zero(2 * n), next = x;
  JumpErrors errors{x.head(n), x.head(n)};
  for (std::size_t j = 0; j < jumps.size(); ++j) {
    x.tail(n) += jumps[j].V;
    const double stretch = (j + 1 < jumps.size() ? jumps[j + 1].t : duration) - jumps[j].t;
    const auto steps = static_cast<long>(std::ceil(stretch / max_step));
    const double dt = stretch / static_cast<double>(steps);
    const MatrixXd X = dt * A;
    const MatrixXd step = I + X * (I + X / 2 * (I + X / 3 * (I + X / 4)));  // Runge-Kutta, order 4
    for (long k = 0; k < steps; ++k) {
      next.noalias() = step * x;
      errors.peak = errors.peak.cwiseMax(next.head(n).cwiseAbs());
      errors.mean += dt / 2 / duration * (x.head(n).cwiseAbs() + next.head(n).cwiseAbs());
      x.swap(next);
    }
  }
  return errors;
}

double peak_after_jump(double V, double omega, double zeta) {
  if (std::abs(zeta - 1) < 1e-9) return V / omega / std::exp(1.0);
  if (zeta < 1) return V / omega * std::exp(-zeta * std::acos(zeta) / std::sqrt(1 - zeta * zeta));
  return V / omega * std::exp(-zeta * std::acosh(zeta) / std::sqrt(zeta * zeta - 1));
}

std::vector<ProfileSegment> segments_of(MotionProfile move, double D, double T) {
  const double v = D / T, a = v / T, j = a / T, s = j / T, c = s / T;  // by powers of 1/T
  const double W = std::numbers::pi / T;
  std::vector<ProfileSegment> pieces;
  switch (move) {
    case MotionProfile::ramp:
      pieces = {{0, v, {}, {{v}}}};
      break;
    case MotionProfile::cubic:
      pieces = {{0, 0, {{6 * a, -12 * j}}, {{0, 6 * a, -6 * j}}}};
      break;
    case MotionProfile::quintic:
      pieces = {{0, 0, {{0, 60 * j, -180 * s, 120 * c}}, {{0, 0, 30 * j, -60 * s, 30 * c}}}};
      break;
    case MotionProfile::cosine:
      pieces = {{0, 0, {{}, D / 2 * W * W, 0}, {{}, 0, D / 2 * W}}};
      break;
    case MotionProfile::bang_bang:
      pieces = {{0, 0, {{4 * a}}, {{0, 4 * a}}}, {T / 2, 0, {{-4 * a}}, {{2 * v, -4 * a}}}};
      break;
  }
  pieces.push_back({T, move == MotionProfile::ramp ? -v : 0, {}, {}});
  return pieces;
}

}  // namespace twinarm
