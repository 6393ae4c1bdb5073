// Stable PD as published (Tan, Liu, Turk 2011, "Stable proportional-derivative controllers"), at
// joints of one degree of freedom:
//
//   tau = -k (q + h qd - q_K') - b (qd + h qdd - qd_K')        ' the end of the step of h
//
// The unknown qdd gives an armature h b: (M + h b) qdd = ... The spring's position lead is h qd,
// without h^2 qdd of the implicit discretization (coupling/laws/spring_damper.h), so there is a
// stability limit. With an inertia I, alpha = k h^2/I and beta = b h/I
// (docs/understand/stability_of_spring_dampers.md):
//
//   x' = x + h v'  (semi-implicit Euler, used here):  alpha < (4 + 2 beta)/3
//   x' = x + h v   (explicit Euler):  alpha < 4 + 2 beta
#include "coupling/laws/coupling_spec.h"

namespace twinarm {
namespace {

class StablePd final : public Coupling {
 public:
  // Throws InputError for joints of several degrees of freedom.
  StablePd(const CouplingSpec& spec, const Model<double>& model, TargetRobot& kvr)
      : Coupling(spec, model, kvr) {
    check_one_dof();
  }
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    const TargetSample& end = kvr_.end();
    for (std::size_t s = 0; s < springs_.size(); ++s) {
      const Spring& spring = springs_[s];
      const auto i = static_cast<std::size_t>(spring.body);
      const std::size_t iq = model_.iq[i], iv = model_.iv[i];
      const double e = end.x.q[iq] - (x.q[iq] + h_ * x.qd[iv]), e_dot = end.x.qd[iv] - x.qd[iv];
      SpringState& reading = readings_[s];
      reading.size = spring.k * e + spring.b * e_dot;
      reading.m_star = h_ * spring.b;
      reading.p_K = end.k.X_WL[i].p;
      reading.p_D = k.X_WL[i].p;
      forces.tau[iv] += reading.size;
      forces.armature[iv] += reading.m_star;
    }
  }
  bool needs_semi_implicit() const override { return true; }
  JointSpace joint_space(const Kinematics&) const override { return joint_space_of_joints(); }
};

}  // namespace

CouplingFacts stable_pd_coupling() {
  return {.name = "stable-pd",
          .order = 6,
          .discretizations = CouplingFacts::Discretizations::own,
          .at_joint = true,
          .step_law = StepLaw::stable_pd,
          .make = make_law<StablePd>};
}

}  // namespace twinarm
