#include "solver/dynamics/kinematics.h"

#include "solver/dynamics/dynamics.h"

namespace twinarm {
Kinematics::Kinematics(const Model<double>& model)
    : X_WL(model.parent.size()),
      w_WL(model.parent.size(), Vector3::Zero()),
      v_WLo(model.parent.size(), Vector3::Zero()),
      R_WB(model.parent.size(), Matrix3::Identity()),
      a_bias(model.parent.size()),
      in_body_axes_(model),
      columns_(model.nv, {Vector3::Zero(), Vector3::Zero()}) {}

Vector3 Kinematics::velocity(int body, const Vector3& p_W) const {
  const auto i = static_cast<std::size_t>(body);
  return v_WLo[i] + w_WL[i].cross(p_W - X_WL[i].p);
}

void forward_kinematics(const Model<double>& model, const State<double>& x, Kinematics& k) {
  const BodyKinematics<double>& w = k.in_body_axes_;
  kinematics(model, x, k.in_body_axes_);
  k.a_bias[0] = {{}, -model.gravity};
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const auto p = static_cast<std::size_t>(model.parent[i]);
    k.a_bias[i] = w.Xup[i] * k.a_bias[p] + w.c[i];
    k.R_WB[i] = to_eigen(w.X0[i].E).transpose();
    k.X_WL[i].p = to_eigen(w.X0[i].r);
    k.X_WL[i].R = k.R_WB[i] * to_eigen(model.R_BL[i]);
    k.w_WL[i] = k.R_WB[i] * to_eigen(w.v[i].w);
    k.v_WLo[i] = k.R_WB[i] * to_eigen(w.v[i].v);
    for (std::size_t dof = model.iv[i]; dof < model.iv[i] + model.dofs(i); ++dof)
      k.columns_[dof] = {k.R_WB[i].lazyProduct(to_eigen(w.S_[dof].w)),
                         k.R_WB[i].lazyProduct(to_eigen(w.S_[dof].v))};
  }
}

Kinematics kinematics_at(const Model<double>& model, const State<double>& x) {
  Kinematics k(model);
  forward_kinematics(model, x, k);
  return k;
}

Eigen::Matrix3Xd point_jacobian(const Model<double>& model, const Kinematics& k, int body,
                                const Vector3& p_W) {
  Eigen::Matrix3Xd J = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(model.nv));
  for_each_dof_below(model, k, body,
                     [&](std::size_t dof, const Vector3& w, const Vector3& v, const Vector3& o) {
                       J.col(static_cast<Eigen::Index>(dof)) = v + w.cross(p_W - o);
                     });
  return J;
}

Eigen::Matrix3Xd rotation_jacobian(const Model<double>& model, const Kinematics& k, int body) {
  Eigen::Matrix3Xd J = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(model.nv));
  for_each_dof_below(model, k, body,
                     [&](std::size_t dof, const Vector3& w, const Vector3&, const Vector3&) {
                       J.col(static_cast<Eigen::Index>(dof)) = w;
                     });
  return J;
}

}  // namespace twinarm
