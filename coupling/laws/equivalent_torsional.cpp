#include "coupling/laws/equivalent_torsional.h"

#include <utility>

#include "coupling/laws/spring_force.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

MatchedTorsional::MatchedTorsional(std::string name, const Model<double>& model,
                                   KinematicRobot& kvr, std::vector<Spring> springs)
    : Coupling(std::move(name), model, kvr, std::move(springs)), iq_(model.nv) {
  FaultList faults;
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    if (model.dofs(i) == 1) iq_[model.iv[i]] = model.iq[i];
  for (const Spring& spring : springs_)
    for (int body = spring.body; body > 0; body = model.parent[static_cast<std::size_t>(body)]) {
      const auto i = static_cast<std::size_t>(body);
      if (model.dofs(i) > 1)
        faults.add({"", 0, "coupling '" + name_ + "', joint '" + model.joint_name[i] + "'",
                    "the joint has " + std::to_string(model.dofs(i)) + " degrees of freedom",
                    "the matched law takes joints of one; choose a linear coupling"});
    }
  faults.check();
}

void MatchedTorsional::begin_step(const Kinematics&, double t, double h) noexcept {
  kvr_.begin_step(t, h);
}

// tau = sum_p J_p^T (k J_p e + b J_p e'), point by point: no matrix, nothing allocated.
void MatchedTorsional::add_forces(const State<double>& x, const Kinematics&,
                                  Forces<double>& forces) noexcept {
  const KvrSample& target = kvr_.at(x.t);
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const Spring& spring = springs_[s];
    const Vector3 p_K = target.k.position(spring.body, spring.p_L);
    const auto for_each_column = [&](auto f) {
      for_each_dof_below(model_, target.k, spring.body,
                         [&](std::size_t dof, const Vector3& w, const Vector3& v,
                             const Vector3& o) { f(dof, Vector3(v + w.cross(p_K - o))); });
    };
    Vector3 pull = Vector3::Zero();
    for_each_column([&](std::size_t dof, const Vector3& J) {
      const double e = target.x.q[iq_[dof]] - x.q[iq_[dof]];
      pull += (spring.k * e + spring.b * (target.x.qd[dof] - x.qd[dof])) * J;
    });
    for_each_column([&](std::size_t dof, const Vector3& J) { forces.tau[dof] += J.dot(pull); });
    readings_[s] = {p_K, p_K, pull, pull.norm()};
  }
}

Coupling::JointSpace MatchedTorsional::joint_space(const Kinematics& k) const {
  return joint_space_of_points(model_, k, springs_);
}

}  // namespace twinarm
