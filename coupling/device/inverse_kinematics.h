// Inverse kinematics of a point of any robot: positions of the driven joints, within their ranges,
// that minimise the distance to a goal.
//
//   min |e|^2,  e = goal - p(q),   lower <= q <= upper
//   (G + mu 1) dq = J^T e,         G = J^T J  or  J^T J - sum_k e_k (d^2 p_k / dq^2)
//
// damped least squares (Levenberg 1944, Marquardt 1963). Within reach G = J^T J gives the minimum
// joint motion. Out of reach, G includes the second derivatives of the point (d^2 p / dq_a dq_b =
// w_a x J_b for revolute joints, a between the base and b): it converges there too, and G^-1 J^T is
// the Jacobian from the goal to the joints. mu increases after a step without progress. Joints
// pushed beyond a bound stay. Cost: one forward kinematics and n^3 / 6 per iteration, one to three
// iterations if the goal moves little. World axes; no allocation after the constructor.
#pragma once

#include <vector>

#include "coupling/device/device_mapping.h"
#include "solver/linear_algebra/dense_spd.h"

namespace twinarm {

class PointInverseKinematics {
 public:
  // The driven joints have one degree of freedom each.
  explicit PointInverseKinematics(const MappedRobot& robot);

  // Sets the joint positions.
  void set_pose(const std::vector<double>& q) noexcept;
  // Minimises the distance to the goal; no joint moves more than `max_change` [rad, m].
  void move_towards(const Vector3& goal, double max_change) noexcept;

  const std::vector<double>& q() const { return q_; }  // in the order of MappedRobot::turned
  const Vector3& position() const { return p_; }       // of the point [m]
  // Force on the goal with the work of tau on the joints, tau . dq = f . dgoal; joints at a bound
  // do not move.
  Vector3 force_of(const std::vector<double>& tau) noexcept;

 private:
  struct Dof {  // of the chain from the point to the base
    Vector3 w, J;
    double ratio;
    std::size_t joint;
  };
  void evaluate(const Vector3& goal);  // kinematics, residual, gradient, free joints
  // False if G + mu 1 is not positive definite. `curved`: with second derivatives.
  bool factorise(double mu, bool curved);
  bool step(const Vector3& goal, double mu, bool curved);
  bool is_at_rest() const;
  void nudge(const Vector3& goal);
  double mean_square() const;  // of the free joints' columns

  const Model<double>& model_;
  int body_;
  Vector3 p_L_, p_ = Vector3::Zero(), e_ = Vector3::Zero();
  State<double> x_;
  Kinematics k_;
  std::vector<std::size_t> iq_;
  DrivenDofs driven_;
  std::vector<double> lower_, upper_;
  std::vector<double> q_, before_, gradient_, dq_, low_, high_;
  std::vector<char> free_;
  std::vector<Dof> chain_;
  DenseSpd G_;
};

}  // namespace twinarm
