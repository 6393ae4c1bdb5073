#include "app/inspect/inspection.h"

#include <utility>

#include "solver/dynamics/dynamics.h"

namespace twinarm {
namespace {

bool is_zero(const Force<double>& f) {
  return dot(f.n, f.n) + dot(f.f, f.f) == 0;
}
bool is_zero(const ArticulatedInertia<double>& a) {
  const auto is_zero_sym = [](const Sym3<double>& s) {
    return s.xx == 0 && s.yy == 0 && s.zz == 0 && s.xy == 0 && s.xz == 0 && s.yz == 0;
  };
  return is_zero_sym(a.I) && is_zero_sym(a.M) &&
         dot(a.H.r0, a.H.r0) + dot(a.H.r1, a.H.r1) + dot(a.H.r2, a.H.r2) == 0;
}

Forces<double> sum_of(const Model<double>& model, const std::vector<Actor>& actors) {
  Forces<double> sum(model);
  for (const Actor& actor : actors) {
    for (const Actor::OnBody& on : actor.bodies) {
      sum.f_ext[on.body] += on.f;
      if (!is_zero(on.impedance)) sum.add_impedance(on.body, on.impedance);
    }
    for (const Actor::OnJoint& on : actor.joints) {
      sum.tau[on.dof] += on.tau;
      sum.armature[on.dof] += on.armature;
    }
  }
  return sum;
}

}  // namespace

Actor actor_of(std::string source, const Forces<double>& added) {
  Actor actor{std::move(source), {}, {}};
  for (std::size_t i = 0; i < added.f_ext.size(); ++i)
    if (!is_zero(added.f_ext[i]) || !is_zero(added.impedance[i]))
      actor.bodies.push_back({i, added.f_ext[i], added.impedance[i]});
  for (std::size_t dof = 0; dof < added.tau.size(); ++dof)
    if (added.tau[dof] != 0 || added.armature[dof] != 0)
      actor.joints.push_back({dof, added.tau[dof], added.armature[dof]});
  return actor;
}

Inspection::Inspection(const Model<double>& model_of, State<double> at, std::vector<Actor> acting,
                       std::vector<LoopClosure> closed)
    : model(model_of),
      x(std::move(at)),
      actors(std::move(acting)),
      loops(std::move(closed)),
      forces(sum_of(model, actors)),
      k(model),
      w(model),
      trace(model.parent.size()) {
  forward_kinematics(model, x, k);
  aba(model, x, forces, w, trace);
}

std::vector<std::size_t> Inspection::children(std::size_t i) const {
  std::vector<std::size_t> found;
  for (std::size_t j = i + 1; j < body_count(); ++j)
    if (parent(j) == i) found.push_back(j);
  return found;
}

}  // namespace twinarm
