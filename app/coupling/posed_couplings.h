// Stiffness, damping and lever arms of each coupling of a scene about one state at rest, with fixed
// targets.
#pragma once

#include "app/coupling/prediction.h"

namespace twinarm {

class PosedCouplings {
 public:
  explicit PosedCouplings(const SimulateInput& input);
  // By rows (app/coupling/prediction.h).
  Eigen::MatrixXd M() const { return by_rows(all_M_); }
  Eigen::MatrixXd joint_damping() const;
  Eigen::VectorXd gravity() const;  // joint forces G(q) that balance gravity
  PredictedCoupling coupling(std::size_t c, double h);
  // About zero offset, in O(n^2): without geometric stiffness, modes and arms.
  PredictedCoupling about_zero(std::size_t c);
  // Smallest apparent inertia in the directions of the coupling, all joints free [kg or kg m^2].
  double apparent_inertia(std::size_t c) const;

 private:
  Eigen::MatrixXd by_rows(const Eigen::MatrixXd& by_velocity) const {
    return P_.transpose() * by_velocity * P_;
  }
  Eigen::MatrixXd tangent(std::size_t c);  // K with the geometric stiffness
  Eigen::MatrixXd jacobian(std::size_t c) const;
  // Rows of M that belong to the coupling's robot.
  Eigen::MatrixXd robot_inertia(const SceneCoupling& spec) const;
  void add_arms(const SceneCoupling& spec, const Vector3& offset, double h,
                PredictedCoupling& found) const;

  const SimulateInput& input_;
  const Model<double>& model_;
  State<double> x_;
  Kinematics k_;
  Eigen::SparseMatrix<double> P_;
  Eigen::MatrixXd all_M_;
  std::size_t velocities_ = 0;  // of the robots, which come first
};

// Terms of the step matrix for steps of h.
CoupledTerm step_part(const PredictedCoupling& coupling, double h);
// Dampers of joints: implicit in the semi-implicit integrators.
CoupledTerm joint_damper_term(const Eigen::MatrixXd& damping, Integrator integrator);

}  // namespace twinarm
