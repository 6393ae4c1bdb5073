// The fair match of a torsional to a linear coupling: a joint-space torsional coupling with the
// FULL stiffness and damping of the linear one, taken at the KVR's pose,
//   tau = K_q(q_K) (q_K - q_D) + B_q(q_K) (qd_K - qd_D).
// Matching k_T = k_L r^2 joint by joint is not fair for a chain: the outer spring also holds the
// inner joint. Explicit only; revolute and prismatic joints only.
#pragma once

#include "coupling/coupling.h"

namespace twinarm {

class MatchedTorsional final : public Coupling {
 public:
  // The springs are those of the linear coupling that is matched.
  MatchedTorsional(std::string name, const Model<double>& model, KinematicRobot& kvr,
                   std::vector<Spring> springs);
  void begin_step(const Kinematics& k, double t, double h) noexcept override;
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  JointSpace joint_space(const Kinematics& k) const override;
};

}  // namespace twinarm
