// Base of all couplings: springs between links of the target robot (KVR) and of the robot (DVR),
// their states, and joint-space stiffness and damping. The target robot's state is a function of
// time (unless its velocities are differences), so it is not serialised.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "coupling/target/target_robot.h"
#include "solver/forces/force_source.h"

namespace twinarm {

// One spring-damper between a link of the KVR and of the DVR. Torsional: orientations or joint
// angles, k [N m/rad], b [N m s/rad] (prismatic joint: k [N/m], b [N s/m]). Linear: points p_L, k
// [N/m], b [N s/m]. Bushing: k, b linear and k_rotational, b_rotational torsional.
struct Spring {
  std::string name;
  int body = 0;
  Vector3 p_L = Vector3::Zero();  // link frame; of couplings at a point [m]
  double k = 0, b = 0;
  double k_rotational = 0, b_rotational = 0;  // of bushings and welds
};

enum class SpringSpace {
  world,  // orientation of the link in the world (as in the paper): external torque on the link
  joint   // coordinate of the link's joint: acts between the link and its parent
};

struct CouplingSpec;

class Coupling : public SpringSource {
 public:
  // Throws InputError with all springs that have an invalid link or a negative gain.
  Coupling(const CouplingSpec& spec, const Model<double>& model, TargetRobot& kvr);

  void begin_step(const Kinematics&, double t, double h) noexcept override {
    h_ = h;
    kvr_.begin_step(t, h);
  }
  const std::string& name() const { return name_; }
  const std::vector<Spring>& springs() const { return springs_; }
  // K_q and B_q at zero tracking error: tau = K_q (q_K - q_D) + B_q (qd_K - qd_D).
  struct JointSpace {
    Eigen::MatrixXd K, B;
    explicit JointSpace(std::size_t nv);  // zero
    // Adds J^T k J and J^T b J.
    void add(double k, double b, const Eigen::Ref<const Eigen::MatrixXd>& J);
  };
  virtual JointSpace joint_space(const Kinematics& k) const = 0;

 protected:
  // Of springs on joints of one degree of freedom.
  JointSpace joint_space_of_joints() const;
  // Throws InputError for springs on joints with more or less than one degree of freedom.
  void check_one_dof() const;

  std::string name_;
  const Model<double>& model_;
  TargetRobot& kvr_;
  std::vector<Spring> springs_;
  double h_ = 0;  // step [s]
};

// Rotation vector [rad] of a rotation matrix, angle in [0, pi].
Vector3 rotation_vector(const Matrix3& R);

}  // namespace twinarm
