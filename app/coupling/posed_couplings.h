// The couplings of a scene about one state at rest: stiffness, damping and lever arms of each, with
// the kinematic side held still.
#pragma once

#include "app/coupling/prediction.h"

namespace twinarm {

class PosedCouplings {
 public:
  explicit PosedCouplings(const SimulateInput& input);
  // By rows (app/coupling/prediction.h).
  Eigen::MatrixXd M() const { return by_rows(all_M_); }
  Eigen::MatrixXd joint_damping() const;
  Eigen::VectorXd gravity() const;  // what holds the robots up: G of M qdd + C + G = tau
  PredictedCoupling coupling(std::size_t c, double h);
  // The same about zero offset, in O(n^2): without the geometric part, the modes and the arms.
  PredictedCoupling about_zero(std::size_t c);
  // What the coupling feels where it is felt least, all else free [kg or kg m^2].
  double apparent_inertia(std::size_t c) const;

 private:
  Eigen::MatrixXd by_rows(const Eigen::MatrixXd& by_velocity) const {
    return P_.transpose() * by_velocity * P_;
  }
  Eigen::MatrixXd tangent(std::size_t c);  // K of its spring, geometric part included
  Eigen::MatrixXd jacobian(std::size_t c) const;
  // Rows of M that belong to the coupling's robot.
  Eigen::MatrixXd robot_inertia(const SceneCoupling& spec) const;
  void add_arms(const SceneCoupling& spec, const Vector3& offset, double h,
                PredictedCoupling& found) const;

  const SimulateInput& input_;
  const Model<double>& model_;
  State<double> x_;
  Kinematics k_;
  Eigen::MatrixXd P_, all_M_;
  std::size_t velocities_ = 0;  // of the robots, which come first
};

// As an integrator steps it, in steps of h.
CoupledTerm step_part(const PredictedCoupling& coupling, double h);

}  // namespace twinarm
