// Inverse kinematics of a point of any robot: the driven joints, within their ranges, that bring it
// nearest to a goal; and how they follow the goal.
//
//   min |e|^2,  e = goal - p(q),   lower <= q <= upper
//   (G + mu 1) dq = J^T e,         G = J^T J  or  J^T J - sum_k e_k (d^2 p_k / dq^2)
//
// damped least squares (Levenberg 1944, Marquardt 1963). Within reach G = J^T J: the least motion
// of the joints that brings the point there. Out of reach the point's second derivatives come in,
// which a chain of hinges has for nothing (d^2 p / dq_a dq_b = w_a x J_b, a between the base and
// b): so it converges there too, and G^-1 J^T is how the joints really follow the goal. mu grows
// where a step does not come nearer. Joints at a bound that are pushed beyond it stand still. Cost:
// one forward kinematics and n^3 / 6 a round, one to three rounds where the goal moves little.
// World axes; nothing is allocated after the constructor.
#pragma once

#include <vector>

#include "coupling/device/device_mapping.h"
#include "solver/linear_algebra/dense_spd.h"

namespace twinarm {

class PointInverse {
 public:
  // The driven joints have one degree of freedom each.
  explicit PointInverse(const MappedRobot& robot);

  // From now on from here.
  void set_pose(const std::vector<double>& q) noexcept;
  // Brings the point as near to the goal as it gets while no joint goes further than `most` from
  // where it stood before this call [rad, m].
  void reach(const Vector3& goal, double most) noexcept;

  const std::vector<double>& q() const { return q_; }  // in the order of MappedRobot::turned
  const Vector3& position() const { return p_; }       // of the point [m]
  // The force on the goal that does the same work as tau on the joints: tau . dq = f . dgoal, at
  // the last goal; joints at a bound do not follow.
  Vector3 force_of(const std::vector<double>& tau) noexcept;

 private:
  struct Dof {  // of the chain between the point and the base, from the point on
    Vector3 w, J;
    double ratio;
    std::size_t joint;
  };
  void look(const Vector3& goal);  // kinematics, residual, gradient, free joints
  // False: G + mu 1 is not positive definite. `curved`: with the second derivatives.
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
