#include "coupling/batch/batch_model.h"

#include "solver/dynamics/kinematics.h"
#include "solver/dynamics/model_builder.h"

namespace twinarm {

ModelWithoutFixedJoints::ModelWithoutFixedJoints(const Model<double>& whole) : model(whole) {
  const std::size_t n = whole.parent.size();
  carrier.assign(n, 0);
  X.resize(n);
  I.resize(n);
  const auto clear = [](auto&... lists) { (lists.clear(), ...); };
  clear(model.body_name, model.joint_name, model.parent, model.last_child, model.joint, model.pitch,
        model.iq, model.iv, model.Xtree, model.I, model.R_BL);
  for (std::size_t i = 0; i < n; ++i) {
    const auto p = static_cast<std::size_t>(i > 0 ? whole.parent[i] : 0);
    const Transform<double> X_joint = i > 0 ? whole.Xtree[i] * X[p] : Transform<double>{};
    if (i > 0 && whole.joint[i] == JointType::fixed) {
      carrier[i] = carrier[p];
      X[i] = X_joint;
    } else {
      carrier[i] = origin.size();
      origin.push_back(i);
      model.body_name.push_back(whole.body_name[i]);
      model.joint_name.push_back(whole.joint_name[i]);
      model.parent.push_back(i > 0 ? static_cast<int>(carrier[p]) : whole.parent[i]);
      model.last_child.push_back(0);
      if (i > 0) model.last_child[carrier[p]] = static_cast<int>(carrier[i]);
      model.joint.push_back(whole.joint[i]);
      model.pitch.push_back(whole.pitch[i]);
      model.iq.push_back(whole.iq[i]);
      model.iv.push_back(whole.iv[i]);
      model.Xtree.push_back(X_joint);
      model.R_BL.push_back(whole.R_BL[i]);
    }
    add_congruence(X[i], whole.I[i], I[i]);
  }
  model.I = inertias({});
  index_names(model);
}

Vec3<double> ModelWithoutFixedJoints::point_of(const Model<double>& whole, std::size_t body,
                                               const Vector3& p_L) const {
  return X[body].r + transpose_times(X[body].E, whole.R_BL[body] * from_eigen(p_L));
}

std::vector<Inertia<double>> ModelWithoutFixedJoints::inertias(
    const std::vector<double>& factor) const {
  std::vector<Inertia<double>> sum(origin.size());
  for (std::size_t i = 1; i < I.size(); ++i) {
    const double f = factor.empty() ? 1 : factor[i];
    Inertia<double>& all = sum[carrier[i]];
    all.m += f * I[i].m;
    all.h += f * I[i].h;
    const Sym3<double>& a = I[i].I;
    all.I += Sym3<double>{f * a.xx, f * a.yy, f * a.zz, f * a.xy, f * a.xz, f * a.yz};
  }
  return sum;
}

}  // namespace twinarm
