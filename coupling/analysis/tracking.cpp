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

ProfileError::ProfileError(MotionProfile move, double D, double T, double omega, double zeta,
                           Damper damper)
    : time_(T), omega_(omega), zeta_(zeta), W_(std::numbers::pi / T), damper_(damper) {
  for (const ProfileSegment& piece : segments_of(move, D, T)) add_piece(piece);
  solve();
}

void ProfileError::add_piece(const ProfileSegment& move) {
  Piece piece{move.start, move.jump, move.acceleration, {}};
  const Forcing& velocity = move.velocity;
  if (damper_ == Damper::absolute) {
    const double by = 2 * zeta_ * omega_;
    std::vector<double>& power = piece.right.power;
    power.resize(std::max(power.size(), velocity.power.size()));
    for (std::size_t n = 0; n < velocity.power.size(); ++n) power[n] += by * velocity.power[n];
    piece.right.c += by * velocity.c;
    piece.right.d += by * velocity.d;
  }
  pieces_.push_back(std::move(piece));
}

// Powers, from the highest down: w^2 p_n + 2 z w (n+1) p_n+1 + (n+1)(n+2) p_n+2 = f_n.
// (c cos + d sin): (w^2 - W^2) C + 2 z w W D = c,  (w^2 - W^2) D - 2 z w W C = d.
void ProfileError::solve() {
  const double w2 = omega_ * omega_, b = 2 * zeta_ * omega_;
  Motion end{0, 0};
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    Piece& piece = pieces_[i];
    const std::vector<double>& f = piece.right.power;
    std::vector<double>& p = piece.particular.power;
    p.assign(f.size() + 2, 0.0);
    for (std::size_t n = f.size(); n-- > 0;) {
      const auto m = static_cast<double>(n);
      p[n] = (f[n] - b * (m + 1) * p[n + 1] - (m + 1) * (m + 2) * p[n + 2]) / w2;
    }
    const double stiff = w2 - W_ * W_, damp = b * W_;
    if (piece.right.c != 0 || piece.right.d != 0) {
      const double all = stiff * stiff + damp * damp;
      piece.particular.c = (stiff * piece.right.c - damp * piece.right.d) / all;
      piece.particular.d = (stiff * piece.right.d + damp * piece.right.c) / all;
    }
    const Motion of = of_particular(piece, 0);
    piece.e = end.e - of.e;
    piece.e_dot = end.e_dot + piece.jump - of.e_dot;
    if (i + 1 < pieces_.size()) end = in_piece(piece, pieces_[i + 1].start - piece.start);
  }
}

ProfileError::Motion ProfileError::of_particular(const Piece& piece, double s) const {
  Motion motion{0, 0};
  const std::vector<double>& p = piece.particular.power;
  for (std::size_t n = p.size(); n-- > 0;) {
    motion.e_dot = motion.e_dot * s + motion.e;
    motion.e = motion.e * s + p[n];
  }
  const double C = piece.particular.c, D = piece.particular.d;
  const double cos = std::cos(W_ * s), sin = std::sin(W_ * s);
  return {motion.e + C * cos + D * sin, motion.e_dot + W_ * (D * cos - C * sin)};
}

// e'' + 2 z w e' + w^2 e = 0. With r^2 = w^2 |1 - z^2|, c and s of cos, sin or of cosh, sinh:
// e = exp(-z w t) (e_0 c(r t) + (e'_0 + z w e_0) s(r t)/r).
ProfileError::Motion ProfileError::free_motion(double e, double e_dot, double t) const {
  const double r = omega_ * std::sqrt(std::abs(1 - zeta_ * zeta_)), zw = zeta_ * omega_;
  const double rate = e_dot + zw * e;
  double c, s_by_r, back;  // back: of c' = back s_by_r
  if (r * t < 1e-8) {
    c = std::exp(-zw * t);
    s_by_r = t * c;
    back = 0;
  } else if (zeta_ < 1) {
    c = std::exp(-zw * t) * std::cos(r * t);
    s_by_r = std::exp(-zw * t) * std::sin(r * t) / r;
    back = -r * r;
  } else {  // both exponentials decay: no overflow
    const double slow = std::exp((r - zw) * t), fast = std::exp(-(r + zw) * t);
    c = (slow + fast) / 2;
    s_by_r = (slow - fast) / (2 * r);
    back = r * r;
  }
  const double now = e * c + rate * s_by_r;
  return {now, -zw * now + e * back * s_by_r + rate * c};
}

double ProfileError::at(double t) const {
  const Piece* piece = &pieces_.front();
  for (const Piece& next : pieces_)
    if (t >= next.start) piece = &next;
  return in_piece(*piece, t - piece->start).e;
}

// Maximum on a fine grid over the move and one period after it, refined by a parabola through three
// points.
double ProfileError::peak() const {
  constexpr double kPerPeriod = 400, kMin = 4000, kMax = 4e6;
  const double period = 2 * std::numbers::pi / omega_, end = time_ + period;
  const double count = std::clamp(kPerPeriod * end / period, kMin, kMax), dt = end / count;
  const auto size = [&](double n) { return std::abs(at(n * dt)); };
  double best = 0, where = 0;
  for (double n = 0; n <= count; ++n)
    if (const double here = size(n); here > best) {
      best = here;
      where = n;
    }
  if (where < 1) return best;
  const double before = size(where - 1), after = size(where + 1);
  const double second = before - 2 * best + after;
  return second < 0 ? best - (after - before) * (after - before) / (8 * second) : best;
}

}  // namespace twinarm
