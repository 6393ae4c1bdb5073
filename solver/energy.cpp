#include "solver/energy.h"

#include "solver/slice.h"

namespace twinarm {

double kinetic_energy(const Model<double>& model, const State<double>& x) {
  std::vector<Motion<double>> v(model.parent.size());
  double sum = 0;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    visit_joint<double>(model.joint[i], [&](auto joint) {
      const Transform<double> Xup = joint.XJ(x.q.data() + model.iq[i]) * model.Xtree[i];
      v[i] = Xup * v[static_cast<std::size_t>(model.parent[i])] +
             times(joint.subspace, slice<joint.nv>(x.qd, model.iv[i]));
    });
    sum += 0.5 * dot(v[i], model.I[i] * v[i]);
  }
  return sum;
}

double potential_energy(const Model<double>& model, const State<double>& x) {
  std::vector<Transform<double>> X0(model.parent.size());  // from world to body
  double sum = 0;
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    visit_joint<double>(model.joint[i], [&](auto joint) {
      X0[i] = joint.XJ(x.q.data() + model.iq[i]) * model.Xtree[i] *
              X0[static_cast<std::size_t>(model.parent[i])];
    });
    const Vec3<double> mass_times_com =
        model.I[i].m * X0[i].r + transpose_times(X0[i].E, model.I[i].h);
    sum -= dot(model.gravity, mass_times_com);
  }
  return sum;
}

}  // namespace twinarm
