// Forward kinematics, RBDA sections 3.4 and 4.1: poses and spatial velocities of the bodies.
//
//   X_i = XJ_i XT_i,   X0_i = X_i X0_p,   v_i = X_i v_p + S_i qd_i,   c_i = cJ_i + v_i x S_i qd_i
//
// Interface: solver/dynamics/dynamics.h, solver/dynamics/kinematics.h.
#pragma once

#include "solver/model/joint_slice.h"
#include "solver/model/workspace.h"
#include "solver/spatial/instruction_set.h"
#include "solver/spatial/sincos_batch.h"

namespace twinarm::TWINARM_ISA {

template <class S>
[[gnu::flatten]] void kinematics(const Model<S>& model, const State<S>& x, BodyKinematics<S>& w) {
  poison_with_nan(w.v, w.c, w.X0);
  w.v[0] = {};
  w.X0[0] = {};
  precompute_sincos(x.q, w.sin, w.cos);
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    visit_joint(model, i, [&](auto joint) TWINARM_KERNEL {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iq = model.iq[i];
      const S *q = x.q.data() + iq, *qd = x.rates(joint, model, i);
      const auto S_i = joint.subspace(q);
      const auto vJ = joint_velocity(joint, S_i, qd);
      w.Xup[i] = joint_transform(joint, q, w.sin.data() + iq, w.cos.data() + iq) * model.Xtree[i];
      w.X0[i] = w.Xup[i] * w.X0[p];
      w.v[i] = w.Xup[i] * w.v[p] + vJ;
      w.c[i] = crm(w.v[i], vJ) + joint.cJ(q, qd);
      store_subspace(S_i, w.S_.data() + model.iv[i]);
    });
}

}  // namespace twinarm::TWINARM_ISA
