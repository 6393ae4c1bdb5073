// How far each joint of a chain stays behind a target that moves: the same as tracking.h
// for all joints together, which pull at one another.
//
//   M e'' + B e' + K e = M a_K(t) + A v_K(t),      e = q_K - q_D,
//
// A the part of B that brakes the follower's own velocity (absolute dampers, joints' friction). In
// the modes that are held, e = X y, X^T M X = 1,
//   y'' + X^T B X y' + W^2 y = X^T (M a_K + A v_K).
// The move's polynomials and cosines obey a linear equation of their own, g' = N g: (y, y', g)
// takes each sampling step by one matrix exponential, exact at the samples. Cost O(samples (2 modes
// + 7)^2).
#pragma once

#include <Eigen/Core>

#include "coupling/analysis/tracking.h"

namespace twinarm {

struct ChainFollower {
  Eigen::MatrixXd M, K, B;
  Eigen::MatrixXd absolute;  // A
};

// The largest |e_j| of each joint; not a number for joints that are not held, and for all where
// springs push away.
class MultiJointTrackingError {
 public:
  explicit MultiJointTrackingError(ChainFollower follower);
  // Whether neither springs nor dampers leave the joint to itself.
  bool is_held(Eigen::Index joint) const { return held_[static_cast<std::size_t>(joint)]; }
  // Behind a target that goes `distance` in `time` [s], all joints at once, from rest.
  Eigen::VectorXd behind(MotionProfile move, const Eigen::VectorXd& distance, double time) const;
  // After a target starts at the speeds v, and after it turns from v to -v, having gone on for
  // long; within `time`, or the period of the slowest mode.
  Eigen::VectorXd after_start(const Eigen::VectorXd& v, double time) const;
  Eigen::VectorXd after_reversal(const Eigen::VectorXd& v, double time) const;
  // e at the speeds v, in the long run: K e = A v. Not a number where it has no bound.
  Eigen::VectorXd lag(const Eigen::VectorXd& v) const;

 private:
  Eigen::VectorXd peaks(const std::vector<ProfileSegment>& pieces, const Eigen::VectorXd& along,
                        const Eigen::VectorXd& e, double end, double turn) const;
  Eigen::VectorXd restrict_to_held(Eigen::VectorXd by_joint, double others) const;

  ChainFollower follower_;
  Eigen::MatrixXd shapes_, damping_;
  Eigen::VectorXd squares_;
  std::vector<bool> held_;
  double slowest_ = 0, fastest_ = 0;  // [rad/s]; 0: no mode has a frequency
};

}  // namespace twinarm
