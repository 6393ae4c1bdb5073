// The fair match of a torsional to a linear coupling: a joint-space torsional coupling with the
// FULL stiffness and damping of the linear one, taken at the KVR's pose,
//   tau = K_q(q_K) (q_K - q_D) + B_q(q_K) (qd_K - qd_D).
// Matching k_T = k_L r^2 joint by joint is not fair for a chain: the outer spring also holds the
// inner joint.
//
// Explicit only: the weightless thing that would stand for h B_q + h^2 K_q is a full matrix over
// all joints, at the KVR's pose; no inertia of a link is, and ABA would no longer be O(n). Joints
// of one degree of freedom only.
#pragma once

#include "coupling/laws/coupling.h"

namespace twinarm {

class MatchedTorsional final : public Coupling {
 public:
  // The springs are those of the linear coupling that is matched. Throws InputError for joints
  // between base and links that have not one degree of freedom.
  MatchedTorsional(std::string name, const Model<double>& model, KinematicRobot& kvr,
                   std::vector<Spring> springs);
  void begin_step(const Kinematics& k, double t, double h) noexcept override;
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  JointSpace joint_space(const Kinematics& k) const override;

 private:
  std::vector<std::size_t> iq_;  // by velocity: the joint's coordinate
};

}  // namespace twinarm
