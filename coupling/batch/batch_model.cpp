#include "coupling/batch/batch_model.h"

#include "solver/dynamics/kinematics.h"
#include "solver/dynamics/model_builder.h"

namespace twinarm {

ModelWithoutFixedJoints::ModelWithoutFixedJoints(const Model<double>& whole) : model(whole) {
  const std::size_t n = whole.parent.size();
  carrier.assign(n, 0);
  X.resize(n);
  const auto clear = [](auto&... lists) { (lists.clear(), ...); };
  clear(model.body_name, model.joint_name, model.parent, model.joint, model.pitch, model.iq,
        model.iv, model.Xtree, model.I, model.R_BL);
  for (std::size_t i = 0; i < n; ++i) {
    const auto p = static_cast<std::size_t>(i > 0 ? whole.parent[i] : 0);
    const Transform<double> X_joint = i > 0 ? whole.Xtree[i] * X[p] : Transform<double>{};
    if (i > 0 && whole.joint[i] == JointType::fixed) {
      carrier[i] = carrier[p];
      X[i] = X_joint;
    } else {
      carrier[i] = model.parent.size();
      model.body_name.push_back(whole.body_name[i]);
      model.joint_name.push_back(whole.joint_name[i]);
      model.parent.push_back(i > 0 ? static_cast<int>(carrier[p]) : whole.parent[i]);
      model.joint.push_back(whole.joint[i]);
      model.pitch.push_back(whole.pitch[i]);
      model.iq.push_back(whole.iq[i]);
      model.iv.push_back(whole.iv[i]);
      model.Xtree.push_back(X_joint);
      model.I.emplace_back();
      model.R_BL.push_back(whole.R_BL[i]);
    }
    if (i == 0) continue;
    Inertia<double> own;
    Inertia<double>& all = model.I[carrier[i]];
    add_congruence(X[i], whole.I[i], own);
    all += own;
  }
  complete_tree(model);
}

Vec3<double> ModelWithoutFixedJoints::point_of(const Model<double>& whole, std::size_t body,
                                               const Vector3& p_L) const {
  return X[body].r + transpose_times(X[body].E, whole.R_BL[body] * from_eigen(p_L));
}

}  // namespace twinarm
