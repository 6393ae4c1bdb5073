// Tracking errors of the coupled joints of a chain behind a moving target.
//
//   M e'' + B e' + K e = M a_K(t) + A v_K(t),      e = q_K - q_D,
//
// A: the part of B that acts on the robot's own velocity (absolute dampers, joint damping). In the
// modes e = X y, X^T M X = 1,
//   y'' + X^T B X y' + W^2 y = X^T (M a_K + A v_K).
// The profile's polynomials and cosines satisfy a linear equation g' = N g: (y, y', g) is advanced
// by one matrix exponential, exact at the samples; between them the rate is taken as linear. Cost
// O(samples (2 modes + 7)^2).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <numbers>

#include "coupling/analysis/tracking.h"

namespace twinarm {

struct ChainDynamics {
  Eigen::MatrixXd M, K, B;
  Eigen::MatrixXd absolute;  // A
};

// Maximum |e_j| of each joint; NaN for joints without coupling, and for all if a mode is statically
// unstable.
class MultiJointTrackingError {
 public:
  explicit MultiJointTrackingError(ChainDynamics dynamics);
  // Whether springs or dampers determine the joint.
  bool is_held(Eigen::Index joint) const { return held_[static_cast<std::size_t>(joint)]; }
  // For a target that moves by `distance` in `time` [s], all joints simultaneously, from rest.
  Eigen::VectorXd behind(MotionProfile move, const Eigen::VectorXd& distance, double time) const;
  // After the target's velocity steps from 0 to v, and from v (steady state) to -v; within `time`
  // or the period of the slowest mode.
  Eigen::VectorXd after_start(const Eigen::VectorXd& v, double time) const {
    const double end = std::max(time, slowest_ > 0 ? 2 * std::numbers::pi / slowest_ : 0);
    return peaks({{0, 1, {}, {{1}}}}, v, Eigen::VectorXd::Zero(v.size()), end, 0);
  }
  Eigen::VectorXd after_reversal(const Eigen::VectorXd& v, double time) const {
    const double end = std::max(time, slowest_ > 0 ? 2 * std::numbers::pi / slowest_ : 0);
    return peaks({{0, -2, {}, {{-1}}}}, v, steady_state(v), end, 0);
  }
  // Steady-state error at constant velocity v: K e = A v. NaN if unbounded.
  Eigen::VectorXd steady_state(const Eigen::VectorXd& v) const;

 private:
  Eigen::VectorXd peaks(const std::vector<ProfileSegment>& pieces, const Eigen::VectorXd& along,
                        const Eigen::VectorXd& e, double end, double W) const;
  Eigen::VectorXd restrict_to_held(Eigen::VectorXd by_joint, double others) const;

  ChainDynamics chain_;
  Eigen::MatrixXd shapes_, damping_;
  Eigen::VectorXd omega_squared_;
  std::vector<bool> held_;
  double slowest_ = 0, fastest_ = 0;  // [rad/s]; 0: no mode has a frequency
};

}  // namespace twinarm
