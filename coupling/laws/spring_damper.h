// Spring-dampers in consistent form: signed vectors, true velocities, any treatment.
//
//   point        F = k (p_K - p_D) + b (v_K - v_D) at a point of a link (the added mass of the
//   paper's
//                Figure 5)
//   orientation  T = k log(R_K R_D^T) + b (w_K - w_D), an external couple on the link
//   frame        both, with gains of their own; isotropic, so the axes of the frame do not matter
//   joint        tau = k (q_K - q_D) + b (qd_K - qd_D), at the joint
//
// Implicit (solver/forces/spring.h): the target at the end of the step, the DVR's velocity times h
// taken off the offset, and a weightless particle (point), flywheel (orientation) or armature
// (joint) of m* = h b + h^2 k. What stays explicit: of a point the geometric stiffness, the turning
// of the lever arm, so that a point at radius r whose target lies at radius R_K is stable only if
//   h^2 k r R_K < 4 I + 2 r^2 (h^2 k + h b)    (docs/understand/stability_of_spring_dampers.md;
//   coupling/analysis/prediction.h)
// and of an orientation the change of the axis of phi with it, which vanishes where the axes of all
// joints are parallel.
#pragma once

#include <limits>
#include <stdexcept>

#include "coupling/laws/coupling_spec.h"
#include "solver/support/state_archive.h"

namespace twinarm {

// When a force is computed: at every step and stage, or once in so many steps and held between.
class Hold {
 public:
  // 0 steps: none is held. Throws std::invalid_argument for an implicit force that is to be held.
  Hold(int steps, Discretization treatment) : every_(steps) {
    if (steps > 0 && treatment != Discretization::explicit_)
      throw std::invalid_argument("a held force is explicit: it cannot see the end of the step");
  }
  void begin_step() {
    fresh_ = every_ == 0 || steps_ % every_ == 0;
    ++steps_;
  }
  bool is_fresh() const { return fresh_; }  // compute it now
  void computed() {
    if (every_ > 0) fresh_ = false;
  }
  void serialize(StateArchive& memory) {
    memory.visit_index(steps_, std::numeric_limits<int>::max() / 2);
  }

 private:
  int every_, steps_ = 0;
  bool fresh_ = true;
};

class SpringDamperCoupling final : public Coupling {
 public:
  enum class Space { point, orientation, frame, joint };
  // CouplingSpec::hold_steps > 0: the force is computed every so many steps and held between
  // (explicit only); 0: at every step and stage. Throws InputError for springs on joints that have
  // not one dof where they act at the joint.
  SpringDamperCoupling(const CouplingSpec& spec, const Model<double>& model, TargetRobot& kvr,
                       Space space);

  void begin_step(const Kinematics& k, double t, double h) noexcept override;
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override;
  bool needs_semi_implicit() const override { return treatment_ != Discretization::explicit_; }
  JointSpace joint_space(const Kinematics& k) const override;
  void serialize(StateArchive& memory) override;

 private:
  void pull_joint(std::size_t s, const DiscretizationTerms& terms, const State<double>& x,
                  const Kinematics& k, Forces<double>& forces);

  Space space_;
  Discretization treatment_;
  Hold hold_;
};

// As CouplingFacts::make.
template <SpringDamperCoupling::Space space>
std::unique_ptr<Coupling> make_spring_damper(const CouplingSpec& spec, const Model<double>& model,
                                             TargetRobot& kvr) {
  return std::make_unique<SpringDamperCoupling>(spec, model, kvr, space);
}

// Each fills the reading and adds its weightless inertia (solver/forces/spring.h); the force itself
// is added by the caller, who may hold it.
//
// F = k (p_K - p_D - position_lead v_D) + b (v_K - v_D), and a particle of m*.
void pull_point(const Spring& spring, const DiscretizationTerms& terms, const Kinematics& D,
                SpringState& reading, Forces<double>& forces);
// T = k (log(R_K R_D^T) - position_lead w_D) + b (w_K - w_D), and a flywheel of m*.
void apply_torsional_spring(int body, double k, double b, const DiscretizationTerms& terms,
                            const Kinematics& D, SpringState& reading, Forces<double>& forces);

// sum of J^T k J and of J^T b J: of springs at points, with J the point's Jacobian; of frames, with
// k_turn, b_turn and the rotation's besides.
Coupling::JointSpace joint_space_of_points(const Model<double>& model, const Kinematics& k,
                                           const std::vector<Spring>& springs);
Coupling::JointSpace joint_space_of_frames(const Model<double>& model, const Kinematics& k,
                                           const std::vector<Spring>& springs);

}  // namespace twinarm
