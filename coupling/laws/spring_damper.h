// Spring-dampers in consistent form: signed vectors, true velocities, any discretization.
//
//   point        F = k (p_K - p_D) + b (v_K - v_D) at a point of a link
//   orientation  T = k log(R_K R_D^T) + b (w_K - w_D), an external torque on the link
//   frame        both, with separate gains; isotropic, so independent of the frame's axes
//   joint        tau = k (q_K - q_D) + b (qd_K - qd_D), at the joint
//
// Implicit (solver/forces/spring.h): target at the end of the step, position error reduced by h
// times the DVR's velocity, and an added inertia m* = h b + h^2 k (particle, flywheel or armature).
// Explicit remains, for a point, the geometric stiffness (rotation of the lever arm): a point at
// radius r with a target at radius R_K is stable only if
//   h^2 k r R_K < 4 I + 2 r^2 (h^2 k + h b)    (docs/understand/stability_of_spring_dampers.md)
// and for an orientation the change of the axis of phi, which vanishes for parallel joint axes.
#pragma once

#include <limits>

#include "coupling/laws/coupling_spec.h"
#include "solver/support/state_archive.h"

namespace twinarm {

class SpringDamperCoupling final : public Coupling {
 public:
  enum class Space { point, orientation, frame, joint };
  // Throws InputError for springs at joints of several degrees of freedom, std::invalid_argument
  // for a held force that is not explicit.
  SpringDamperCoupling(const CouplingSpec& spec, const Model<double>& model, TargetRobot& kvr,
                       Space space);

  void begin_step(const Kinematics& k, double t, double h) noexcept override {
    Coupling::begin_step(k, t, h);
    is_fresh_ = hold_steps_ == 0 || steps_ % hold_steps_ == 0;
    ++steps_;
  }
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  bool needs_semi_implicit() const override { return discretization_ != Discretization::explicit_; }
  JointSpace joint_space(const Kinematics& k) const override;
  void serialize(StateArchive& memory) override {
    Coupling::serialize(memory);
    memory.visit_index(steps_, std::numeric_limits<int>::max() / 2);
  }

 private:
  void apply_joint_spring(std::size_t s, const DiscretizationTerms& terms, const State<double>& x,
                          const Kinematics& k, Forces<double>& forces);

  Space space_;
  Discretization discretization_;
  int hold_steps_;  // zero-order hold: compute the force every n steps; 0: at every step and stage
  int steps_ = 0;
  bool is_fresh_ = true;  // compute it now
};

// For CouplingFacts::make.
template <SpringDamperCoupling::Space space>
std::unique_ptr<Coupling> make_spring_damper(const CouplingSpec& spec, const Model<double>& model,
                                             TargetRobot& kvr) {
  return std::make_unique<SpringDamperCoupling>(spec, model, kvr, space);
}

// Each computes the spring's state and adds its added inertia (solver/forces/spring.h); the caller
// adds the force.
// F = k (p_K - p_D - position_lead v_D) + b (v_K - v_D), and a particle of m*.
void apply_point_spring(const Spring& spring, const DiscretizationTerms& terms, const Kinematics& D,
                        SpringState& reading, Forces<double>& forces);
// T = k (log(R_K R_D^T) - position_lead w_D) + b (w_K - w_D), and a flywheel of m*.
void apply_torsional_spring(int body, double k, double b, const DiscretizationTerms& terms,
                            const Kinematics& D, SpringState& reading, Forces<double>& forces);

// Sums of J^T k J and J^T b J with the Jacobians of the points; of frames also with k_rotational,
// b_rotational and the rotation Jacobians.
Coupling::JointSpace joint_space_of_points(const Model<double>& model, const Kinematics& k,
                                           const std::vector<Spring>& springs);
Coupling::JointSpace joint_space_of_frames(const Model<double>& model, const Kinematics& k,
                                           const std::vector<Spring>& springs);

}  // namespace twinarm
