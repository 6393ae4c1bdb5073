// The torsional coupling equivalent to a linear one: joint-space torques with the full stiffness
// and damping matrices of the linear coupling at the KVR's pose,
//   tau = K_q(q_K) (q_K - q_D) + B_q(q_K) (qd_K - qd_D).
// Gains k_T = k_L r^2 by joint are not equivalent for a chain: the outer spring also acts on the
// inner joint.
//
// Explicit only: the added inertia h B_q + h^2 K_q is a full matrix, not an inertia of links, so
// ABA would not be O(n). Joints of one degree of freedom only.
#include "coupling/laws/spring_damper.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

class EquivalentTorsional final : public Coupling {
 public:
  // The springs are those of the linear coupling. Throws InputError if a joint between the base and
  // the links has more than one degree of freedom.
  EquivalentTorsional(const CouplingSpec& spec, const Model<double>& model, TargetRobot& kvr)
      : Coupling(spec, model, kvr), iq_(model.nv) {
    DiagnosticList faults;
    for (std::size_t i = 1; i < model.parent.size(); ++i)
      if (model.dofs(i) == 1) iq_[model.iv[i]] = model.iq[i];
    for (const Spring& spring : springs_)
      for (int body = spring.body; body > 0; body = model.parent[static_cast<std::size_t>(body)]) {
        const auto i = static_cast<std::size_t>(body);
        if (model.dofs(i) > 1)
          faults.add("coupling '" + name_ + "', joint '" + model.joint_name[i] + "'",
                     "the joint has " + std::to_string(model.dofs(i)) + " degrees of freedom",
                     "use joints of one degree of freedom, or a linear coupling",
                     "coupling.degrees-of-freedom");
      }
    faults.check();
  }
  // tau = sum_p J_p^T (k J_p e + b J_p e'), without matrices.
  void add_forces(const State<double>& x, const Kinematics&,
                  Forces<double>& forces) noexcept override {
    const TargetSample& target = kvr_.at(x.t);
    for (std::size_t s = 0; s < springs_.size(); ++s) {
      const Spring& spring = springs_[s];
      const Vector3 p_K = target.k.position(spring.body, spring.p_L);
      const auto for_each_column = [&](auto f) {
        for_each_dof_below(model_, target.k, spring.body,
                           [&](std::size_t dof, const Vector3& w, const Vector3& v,
                               const Vector3& o) { f(dof, Vector3(v + w.cross(p_K - o))); });
      };
      Vector3 force = Vector3::Zero();
      for_each_column([&](std::size_t dof, const Vector3& J) {
        const double e = target.x.q[iq_[dof]] - x.q[iq_[dof]];
        force += (spring.k * e + spring.b * (target.x.qd[dof] - x.qd[dof])) * J;
      });
      for_each_column([&](std::size_t dof, const Vector3& J) { forces.tau[dof] += J.dot(force); });
      readings_[s] = {p_K, p_K, force, force.norm()};
    }
  }
  JointSpace joint_space(const Kinematics& k) const override {
    return joint_space_of_points(model_, k, springs_);
  }

 private:
  std::vector<std::size_t> iq_;  // by velocity: index of the coordinate
};

}  // namespace

CouplingFacts equivalent_torsional_coupling() {
  return {.name = "equivalent-torsional",
          .order = 5,
          .at_point = true,
          .make = make_law<EquivalentTorsional>};
}

}  // namespace twinarm
