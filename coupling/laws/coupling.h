// What every coupling has: springs that pull links of the DVR after the KVR, readings of their
// forces, and the joint-space stiffness and damping that its predictions are made of. The kinematic
// robot is a function of time, unless its rates are differences: what a coupling remembers leaves
// it out.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "coupling/target/target_robot.h"
#include "solver/forces/spring_source.h"

namespace twinarm {

// One spring-damper. Torsional: between the orientations (or joint angles) of the link in the KVR
// and in the DVR, k [N m/rad], b [N m s/rad]. Linear: between the points p_L of the link in both,
// k [N/m], b [N s/m]. On a prismatic joint, `joint` measure: k [N/m], b [N s/m]. In six dimensions:
// k, b at the point, k_turn, b_turn between the orientations.
struct Spring {
  std::string name;
  int body = 0;
  Vector3 p_L = Vector3::Zero();  // link axes, from the link's origin; of couplings at a point
  double k = 0, b = 0;
  double k_turn = 0, b_turn = 0;  // of couplings in six dimensions
};

enum class SpringSpace {
  world,  // orientation of the link in the world (the paper's): an external couple on the link
  joint   // coordinate of the joint that carries the link: acts between the link and its parent
};

struct CouplingSpec;

class Coupling : public SpringSource {
 public:
  // Throws InputError with all springs that name no moving link or have a gain below zero.
  Coupling(const CouplingSpec& spec, const Model<double>& model, TargetRobot& kvr);

  void begin_step(const Kinematics& k, double t, double h) noexcept override;
  const std::string& name() const { return name_; }
  const std::vector<Spring>& springs() const { return springs_; }
  // K_q and B_q about zero offset at a pose: tau = K_q (q_K - q_D) + B_q (qd_K - qd_D).
  struct JointSpace {
    Eigen::MatrixXd K, B;
    explicit JointSpace(std::size_t nv);  // zero
    // J^T k J and J^T b J.
    void add(double k, double b, const Eigen::Ref<const Eigen::MatrixXd>& J);
  };
  virtual JointSpace joint_space(const Kinematics& k) const = 0;

 protected:
  // d(coordinate of the joint that carries the body)/dq, 1 x nv.
  Eigen::MatrixXd joint_row(int body) const;
  // Faults of springs on joints that have not one degree of freedom. Throws InputError.
  void check_one_dof() const;

  std::string name_;
  const Model<double>& model_;
  TargetRobot& kvr_;
  std::vector<Spring> springs_;
  double h_ = 0;  // step [s]
};

// Rotation vector [rad] of a rotation matrix, angle in [0, pi]; at pi either axis.
Vector3 rotation_vector(const Matrix3& R);

}  // namespace twinarm
