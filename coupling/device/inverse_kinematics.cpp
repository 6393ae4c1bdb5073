#include "coupling/device/inverse_kinematics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/model/mimic.h"

namespace twinarm {
namespace {

constexpr int kMaxIterations = 30;
constexpr double kNear = 1e-12;       // convergence [m]
constexpr double kFloor = 1e-10;      // minimum of mu, in mean squares of J's columns
constexpr double kOutOfReach = 1e-9;  // [m]
constexpr double kStretched = 1e-3;   // [rad]

}  // namespace

PointInverseKinematics::PointInverseKinematics(const MappedRobot& robot)
    : model_(*robot.model),
      body_(robot.body),
      p_L_(robot.p_L),
      x_(robot.rest.q.size() == robot.model->nq ? robot.rest : State<double>(*robot.model)),
      k_(*robot.model),
      driven_(*robot.model, robot.turned),
      lower_(robot.lower),
      upper_(robot.upper),
      G_(robot.turned.size()) {
  const std::size_t n = robot.turned.size();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (lower_.empty()) lower_.assign(n, -kInfinity);
  if (upper_.empty()) upper_.assign(n, kInfinity);
  for (std::size_t j = 0; j < n; ++j) {
    const auto b = static_cast<std::size_t>(robot.turned[j]);
    iq_.push_back(model_.iq[b]);
    q_.push_back(std::clamp(x_.q[iq_[j]], lower_[j], upper_[j]));
  }
  before_ = gradient_ = dq_ = low_ = high_ = q_;
  free_.assign(n, 1);
  chain_.reserve(model_.nv);
  set_pose(std::vector<double>(q_));
}

void PointInverseKinematics::set_pose(const std::vector<double>& q) noexcept {
  for (std::size_t j = 0; j < q_.size(); ++j) {
    q_[j] = std::clamp(q[j], lower_[j], upper_[j]);
    low_[j] = lower_[j];
    high_[j] = upper_[j];
  }
  evaluate(p_);
  evaluate(p_);  // goal = the new position
}

void PointInverseKinematics::evaluate(const Vector3& goal) {
  for (std::size_t j = 0; j < q_.size(); ++j) x_.q[iq_[j]] = q_[j];
  apply_mimics(model_, x_);
  forward_kinematics(model_, x_, k_);
  p_ = k_.position(body_, p_L_);
  e_ = goal - p_;
  chain_.clear();
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  for_each_dof_below(model_, k_, body_,
                     [&](std::size_t dof, const Vector3& w, const Vector3& v, const Vector3& o) {
                       if (driven_.joint[dof] < 0) return;
                       const auto joint = static_cast<std::size_t>(driven_.joint[dof]);
                       chain_.push_back({w, v + w.cross(p_ - o), driven_.ratio[dof], joint});
                       gradient_[joint] += driven_.ratio[dof] * chain_.back().J.dot(e_);
                     });
  for (std::size_t j = 0; j < q_.size(); ++j)
    free_[j] = !(q_[j] <= low_[j] && gradient_[j] < 0) && !(q_[j] >= high_[j] && gradient_[j] > 0);
}

double PointInverseKinematics::mean_square() const {
  double sum = 0;
  for (const Dof& dof : chain_) sum += dof.ratio * dof.ratio * dof.J.squaredNorm();
  return chain_.empty() ? 1 : sum / static_cast<double>(chain_.size());
}

bool PointInverseKinematics::factorise(double mu, bool curved) {
  const std::size_t n = q_.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) G_(i, j) = i == j ? mu + (free_[i] ? 0 : 1) : 0;
  for (std::size_t b = 0; b < chain_.size(); ++b)  // a is between the base and b, or b itself
    for (std::size_t a = b; a < chain_.size(); ++a) {
      const Dof &A = chain_[a], &B = chain_[b];
      if (!free_[A.joint] || !free_[B.joint]) continue;
      const double second = curved ? e_.dot(A.w.cross(B.J)) : 0;
      const double g = A.ratio * B.ratio * (A.J.dot(B.J) - second);
      const std::size_t row = std::max(A.joint, B.joint), column = std::min(A.joint, B.joint);
      G_(row, column) += a != b && row == column ? 2 * g : g;
    }
  return G_.factorise(n);
}

bool PointInverseKinematics::is_at_rest() const {
  double max_gradient = 0;
  for (std::size_t j = 0; j < q_.size(); ++j)
    if (free_[j]) max_gradient = std::max(max_gradient, std::abs(gradient_[j]));
  return max_gradient <= 1e-12 * std::sqrt(mean_square()) * e_.norm();
}

bool PointInverseKinematics::step(const Vector3& goal, double mu, bool curved) {
  if (!(curved && factorise(mu, true))) factorise(mu, false);
  for (std::size_t j = 0; j < q_.size(); ++j) dq_[j] = free_[j] ? gradient_[j] : 0;
  G_.solve(dq_.data());
  before_ = q_;
  const double far = e_.squaredNorm();
  for (std::size_t j = 0; j < q_.size(); ++j)
    if (free_[j]) q_[j] = std::clamp(q_[j] + dq_[j], low_[j], high_[j]);
  evaluate(goal);
  if (e_.squaredNorm() < far) return true;
  q_ = before_;
  evaluate(goal);
  return false;
}

// Leaves the saddle point of a stretched arm.
void PointInverseKinematics::nudge(const Vector3& goal) {
  for (std::size_t j = 0; j < q_.size(); ++j)
    q_[j] = std::clamp(q_[j] + kStretched * static_cast<double>(j), low_[j], high_[j]);
  evaluate(goal);
}

void PointInverseKinematics::move_towards(const Vector3& goal, double max_change) noexcept {
  for (std::size_t j = 0; j < q_.size(); ++j) {
    low_[j] = std::max(lower_[j], q_[j] - max_change);
    high_[j] = std::min(upper_[j], q_[j] + max_change);
  }
  evaluate(goal);
  const double size = mean_square(), floor = kFloor * size;
  double mu = floor;
  bool nudged = false, curved = false;
  for (int iteration = 0; iteration < kMaxIterations && e_.norm() > kNear; ++iteration) {
    if (is_at_rest()) {
      if (nudged || factorise(floor, true)) return;  // a minimum
      nudged = true;
      nudge(goal);
    }
    const double far = e_.norm();
    if (step(goal, mu, curved)) {
      mu = std::max(floor, mu / 16);
      curved = curved || e_.norm() > std::max(kOutOfReach, 0.3 * far);
    } else {
      if (mu > 1e6 * (size + e_.norm())) return;  // no progress: rounding
      mu = std::max(8 * mu, 1e-4 * size);
    }
  }
}

Vector3 PointInverseKinematics::force_of(const std::vector<double>& tau) noexcept {
  const double floor = kFloor * mean_square();
  if (!factorise(floor, e_.norm() > kOutOfReach)) return Vector3::Zero();
  for (std::size_t j = 0; j < q_.size(); ++j) dq_[j] = free_[j] ? tau[j] : 0;
  G_.solve(dq_.data());
  Vector3 force = Vector3::Zero();
  for (const Dof& dof : chain_)
    if (free_[dof.joint]) force += dof.ratio * dq_[dof.joint] * dof.J;
  return force;
}

}  // namespace twinarm
