// Linear spring-dampers in consistent form: F = k (x_K - x_D) + b (v_K - v_D) at a point of a link
// (the added mass of the paper's Figure 5), true velocities, any treatment.
//
// Implicit (solver/forces/spring.h): the target at the end of the step and a weightless particle of
// mass m* = h b + h^2 k. What stays explicit is the geometric stiffness, the turning of the lever
// arm: a point at radius r whose target lies at radius R_K is stable only if
//   h^2 k r R_K < 4 I + 2 r^2 (h^2 k + h b)      (docs/coupling.md;
//   coupling/analysis/prediction.h).
#pragma once

#include "coupling/laws/coupling.h"
#include "coupling/laws/zero_order_hold.h"

namespace twinarm {

class LinearCoupling final : public Coupling {
 public:
  // hold_steps > 0: the force is computed every hold_steps steps and held between (explicit only);
  // 0: at every step and stage.
  LinearCoupling(std::string name, const Model<double>& model, KinematicRobot& kvr,
                 std::vector<Spring> springs, Treatment treatment, int hold_steps = 0);

  void begin_step(const Kinematics& k, double t, double h) noexcept override;
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  bool needs_semi_implicit() const override { return treatment_ != Treatment::explicit_; }
  JointSpace joint_space(const Kinematics& k) const override;
  void visit_memory(Memory& memory) override;

 private:
  Treatment treatment_;
  Hold hold_;
};

}  // namespace twinarm
