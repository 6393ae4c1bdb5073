#include "coupling/analysis/multi_joint_tracking.h"

#include <cmath>
#include <limits>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>

#include "coupling/analysis/joint_space_stiffness.h"

namespace twinarm {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
// g = (1, s, s^2, s^3, s^4, cos W s, sin W s).
constexpr Index kPowers = 5, kTerms = 7;

MatrixXd rates_of_terms(double W) {
  MatrixXd N = MatrixXd::Zero(kTerms, kTerms);
  for (Index n = 1; n < kPowers; ++n) N(n, n - 1) = static_cast<double>(n);
  N(kPowers, kPowers + 1) = -W;
  N(kPowers + 1, kPowers) = W;
  return N;
}

Eigen::RowVectorXd coefficients(const ProfileSegment::Series& series) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(kTerms);
  for (std::size_t n = 0; n < series.power.size(); ++n)
    row[static_cast<Index>(n)] = series.power[n];
  row[kPowers] = series.c;
  row[kPowers + 1] = series.d;
  return row;
}

// Largest |e| between two samples h apart, for a rate that is linear between them.
double peak_between(double e, double rate, double next, double next_rate, double h) {
  const double top = rate * next_rate < 0 ? e + h * rate * rate / (2 * (rate - next_rate)) : e;
  return std::max(std::abs(top), std::abs(next));
}

}  // namespace

MultiJointTrackingError::MultiJointTrackingError(ChainDynamics dynamics)
    : chain_(std::move(dynamics)) {
  const SpringModes modes = spring_modes(chain_.M, chain_.K, chain_.B);
  shapes_ = modes.shapes;
  damping_ = modes.damping;
  omega_squared_ = modes.omega_squared;
  // e_j is determined by the modes if row j of their projection is a unit row.
  const MatrixXd spanned = shapes_ * shapes_.transpose() * chain_.M;
  for (Index j = 0; j < spanned.rows(); ++j) {
    VectorXd rest = spanned.row(j);
    rest[j] -= 1;
    held_.push_back(rest.cwiseAbs().maxCoeff() < 1e-6);
  }
  for (Index i = 0; i < modes.size(); ++i) {
    const double w = modes.omega(i);
    if (w > 0) slowest_ = slowest_ > 0 ? std::min(slowest_, w) : w;
    fastest_ = std::max(fastest_, w);
  }
}

VectorXd MultiJointTrackingError::restrict_to_held(VectorXd by_joint, double others) const {
  for (Index j = 0; j < by_joint.size(); ++j)
    if (!is_held(j)) by_joint[j] = others;
  return by_joint;
}

VectorXd MultiJointTrackingError::behind(MotionProfile move, const VectorXd& distance,
                                         double time) const {
  const double end = time + (slowest_ > 0 ? 2 * std::numbers::pi / slowest_ : 0);
  return peaks(segments_of(move, 1, time), distance, VectorXd::Zero(distance.size()), end,
               std::numbers::pi / time);
}

VectorXd MultiJointTrackingError::steady_state(const VectorXd& v) const {
  const VectorXd load = shapes_.transpose() * (chain_.absolute * restrict_to_held(v, 0));
  VectorXd y = VectorXd::Zero(load.size());
  for (Index i = 0; i < y.size(); ++i)
    if (std::abs(load[i]) > 1e-10 * load.cwiseAbs().maxCoeff())
      y[i] = omega_squared_[i] > 0 ? load[i] / omega_squared_[i] : kNone;
  return restrict_to_held(shapes_ * y, kNone);
}

// Segments of a unit move; `along`: distances of the joints; e: initial error at rest.
VectorXd MultiJointTrackingError::peaks(const std::vector<ProfileSegment>& pieces,
                                        const VectorXd& along, const VectorXd& e, double end,
                                        double W) const {
  constexpr double kPerPeriod = 400, kMin = 4000, kMax = 2e5;
  const Index m = omega_squared_.size();
  if (m == 0 || omega_squared_.minCoeff() < 0) return VectorXd::Constant(along.size(), kNone);
  const VectorXd D = restrict_to_held(along, 0);
  const VectorXd by_a = shapes_.transpose() * (chain_.M * D);
  const VectorXd by_v = shapes_.transpose() * (chain_.absolute * D);
  const double samples =
      std::clamp(kPerPeriod * end * fastest_ / (2 * std::numbers::pi), kMin, kMax);
  VectorXd z = VectorXd::Zero(2 * m + kTerms), peak = VectorXd::Zero(along.size());
  z.head(m) = shapes_.transpose() * (chain_.M * restrict_to_held(e, 0));
  MatrixXd A = MatrixXd::Zero(z.size(), z.size());
  A.block(0, m, m, m).setIdentity();
  A.block(m, 0, m, m).diagonal() = -omega_squared_;
  A.block(m, m, m, m) = -damping_;
  A.bottomRightCorner(kTerms, kTerms) = rates_of_terms(W);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const ProfileSegment& piece = pieces[p];
    A.block(m, 2 * m, m, kTerms) =
        by_a * coefficients(piece.acceleration) + by_v * coefficients(piece.velocity);
    z.segment(m, m) += piece.jump * by_a;
    z.tail(kTerms) << 1, VectorXd::Zero(kPowers - 1), 1, 0;
    const double until = p + 1 < pieces.size() ? pieces[p + 1].start : end;
    const double count = std::max(1.0, std::ceil(samples * (until - piece.start) / end));
    const double h = (until - piece.start) / count;
    const MatrixXd step = (h * A).exp();
    VectorXd error = shapes_ * z.head(m), rate = shapes_ * z.segment(m, m);
    for (double n = 0; n < count; ++n) {
      z = VectorXd(step * z);
      const VectorXd next = shapes_ * z.head(m), next_rate = shapes_ * z.segment(m, m);
      for (Index j = 0; j < peak.size(); ++j)
        peak[j] = std::max(peak[j], peak_between(error[j], rate[j], next[j], next_rate[j], h));
      error = next, rate = next_rate;
    }
  }
  return restrict_to_held(peak.cwiseMax(e.cwiseAbs()), kNone);
}

}  // namespace twinarm
