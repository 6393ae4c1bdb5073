// Torsional spring-dampers in consistent form: signed vectors, true velocities, any treatment.
//
//   world   T = k log(R_K R_D^T) + b (w_K - w_D), an external couple on the link
//   joint   tau = k (q_K - q_D) + b (qd_K - qd_D), at the joint
//
// Implicit (solver/forces/spring.h): the target at the end of the step, phi less h w_D, and a
// weightless flywheel (world) or armature (joint) of m* = h b + h^2 k. What stays explicit is the
// change of the axis of phi with the orientation: it vanishes where the axes of all joints are
// parallel.
#pragma once

#include "coupling/laws/coupling.h"
#include "coupling/laws/discretization.h"
#include "coupling/laws/zero_order_hold.h"

namespace twinarm {

class TorsionalCoupling final : public Coupling {
 public:
  // hold_steps > 0: the couple is computed every hold_steps steps and held between (explicit only);
  // 0: at every step and stage. Throws InputError for springs on joints that have not one dof where
  // they are measured at the joint.
  TorsionalCoupling(std::string name, const Model<double>& model, KinematicRobot& kvr,
                    std::vector<Spring> springs, Measure measure, Treatment treatment,
                    int hold_steps = 0);

  void begin_step(const Kinematics& k, double t, double h) noexcept override;
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  bool needs_semi_implicit() const override { return treatment_ != Treatment::explicit_; }
  JointSpace joint_space(const Kinematics& k) const override;
  void visit_memory(Memory& memory) override;

 private:
  void pull_joint(std::size_t s, const TreatmentTerms& terms, const State<double>& x,
                  const Kinematics& k, Forces<double>& forces);

  Measure measure_;
  Treatment treatment_;
  Hold hold_;
};

}  // namespace twinarm
