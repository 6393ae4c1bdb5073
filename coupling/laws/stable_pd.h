// Stable PD (Tan, Liu, Turk 2011, "Stable proportional-derivative controllers"), as printed, at the
// joints of one degree of freedom that carry the springs' links:
//
//   tau = -k (q + h qd - q_K') - b (qd + h qdd - qd_K')        ' the end of the step of h
//
// The unknown qdd stands on the left: (M + h b) qdd = ..., an armature h b. The spring looks ahead
// by h qd alone, without the h^2 qdd that the implicit treatment (torsional.h) has besides; so it
// is not stable at every gain. On an inertia I, with alpha = k h^2/I and beta = b h/I:
//
//   x' = x + h v'  (semi-implicit Euler, the one that this program steps it with)
//        alpha < (4 + 2 beta)/3
//   x' = x + h v   (explicit Euler):  alpha < 4 + 2 beta
//
// The derivation is in docs/coupling.md. It is a treatment of its own: there is no other.
#pragma once

#include "coupling/laws/coupling.h"

namespace twinarm {

class StablePd final : public Coupling {
 public:
  // Throws InputError for joints that have not one degree of freedom.
  StablePd(std::string name, const Model<double>& model, KinematicRobot& kvr,
           std::vector<Spring> springs);

  void begin_step(const Kinematics& k, double t, double h) noexcept override;
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  bool needs_semi_implicit() const override { return true; }
  JointSpace joint_space(const Kinematics& k) const override;
};

// The limit above, of the scheme with x' = x + h v'.
constexpr bool stable_pd_is_stable(double alpha, double beta) {
  return beta >= 0 && 3 * alpha < 4 + 2 * beta;
}

}  // namespace twinarm
