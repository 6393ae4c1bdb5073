#include "solver/dynamics/derivatives.h"

#include "solver/model/convert_model.h"

namespace twinarm {
namespace {

using D = Dual<8>;
constexpr std::size_t kDirections = 8;

Forces<D> convert_forces(const Model<D>& model, const Forces<double>& forces) {
  Forces<D> out(model);
  for (std::size_t k = 0; k < model.nv; ++k) {
    out.tau[k] = forces.tau[k];
    out.armature[k] = forces.armature[k];
  }
  for (std::size_t i = 0; i < model.parent.size(); ++i) {
    out.f_ext[i] = {convert<D>(forces.f_ext[i].n), convert<D>(forces.f_ext[i].f)};
    if (forces.has_added_inertia)
      out.add_inertia(i,
                      {convert<D>(forces.added_inertia[i].I), convert<D>(forces.added_inertia[i].H),
                       convert<D>(forces.added_inertia[i].M)});
  }
  return out;
}

}  // namespace

ForwardDynamicsDerivatives forward_dynamics_derivatives(const Model<double>& model,
                                                        const State<double>& x,
                                                        const Forces<double>& forces) {
  const auto n = static_cast<Eigen::Index>(model.nv);
  ForwardDynamicsDerivatives out{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, n)};
  const Model<D> dual_model = convert<D>(model);
  const Forces<D> dual_forces = convert_forces(dual_model, forces);
  Workspace<D> w(dual_model);

  const auto differentiate = [&](Eigen::MatrixXd& derivative, auto&& seed) {
    for (std::size_t first = 0; first < model.nv; first += kDirections) {
      State<D> at = convert<D>(x);
      std::vector<D> delta(model.nv);
      const std::size_t count = std::min(kDirections, model.nv - first);
      for (std::size_t k = 0; k < count; ++k) seed(at, delta, first + k, static_cast<int>(k));
      for (std::size_t i = 1; i < model.parent.size(); ++i)
        visit_joint(dual_model, i, [&](auto joint) {
          joint.integrate(at.q.data() + model.iq[i], delta.data() + model.iv[i],
                          at.q.data() + model.iq[i]);
        });
      aba(dual_model, at, dual_forces, w);
      for (std::size_t row = 0; row < model.nv; ++row)
        for (std::size_t k = 0; k < count; ++k)
          derivative(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(first + k)) =
              w.qdd[row].d[static_cast<int>(k)];
    }
  };
  using Numbers = std::vector<D>;
  differentiate(out.dq,
                [](State<D>&, Numbers& delta, std::size_t dof, int k) { delta[dof].d[k] = 1; });
  differentiate(out.dqd,
                [](State<D>& at, Numbers&, std::size_t dof, int k) { at.qd[dof].d[k] = 1; });
  return out;
}

}  // namespace twinarm
