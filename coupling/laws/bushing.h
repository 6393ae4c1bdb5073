// A bushing in six dimensions, at a frame fixed to a link: a point spring at its origin and a
// torsional one on the link's orientation in the world, each with its own gains,
//
//   F = k (p_K - p_D) + b (v_K - v_D)           at the point p_L
//   T = k_turn log(R_K R_D^T) + b_turn (w_K - w_D)
//
// Both are isotropic, so the axes of the frame do not matter. Implicit: a weightless particle and a
// weightless flywheel (docs/coupling.md, 2); what stays explicit is what stays so of the two.
#pragma once

#include "coupling/laws/coupling.h"
#include "coupling/laws/zero_order_hold.h"

namespace twinarm {

class Bushing final : public Coupling {
 public:
  // hold_steps as of LinearCoupling.
  Bushing(std::string name, const Model<double>& model, KinematicRobot& kvr,
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
