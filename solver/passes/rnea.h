// Inverse dynamics by the recursive Newton-Euler algorithm (RNEA), RBDA section 5.3, table 5.1.
//
//   tau = M qdd + C(q, qd, f_ext),  in O(n), in body axes:
//
//   base to tips   v_i = X_i v_p + S_i qd_i,   a_i = X_i a_p + c_i + S_i qdd_i,
//                  f_i = I_i a_i + v_i x* I_i v_i - f_ext_i
//   tips to base   tau_i = S_i^T f_i,   f_p += X_i^T f_i
//
// Writes w.f, the wrench that the parent exerts on body i through joint i, and w.tau. Rotor inertia
// (armature qdd) is added to w.tau only. Interface: solver/dynamics/dynamics.h.
#pragma once

#include "solver/model/joint_slice.h"
#include "solver/model/workspace.h"
#include "solver/spatial/instruction_set.h"

namespace twinarm::TWINARM_ISA {

template <class S>
[[gnu::flatten]] void rnea(const Model<S>& model, const State<S>& x, const std::vector<S>& qdd,
                           const std::vector<Force<S>>& f_ext, Workspace<S>& w) {
  const std::size_t n_bodies = model.parent.size();
  poison_with_nan(w.v, w.c, w.a, w.f, w.tau);
  w.v[0] = {};
  w.a[0] = {{}, -model.gravity};  // gravity as a fictitious acceleration of the base, a_0 = -a_g
  w.f[0] = {};

  // base to tips: velocities, accelerations and the net wrench of each body
  for (std::size_t i = 1; i < n_bodies; ++i)
    visit_joint(model, i, [&](auto joint) TWINARM_KERNEL {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const S *q = x.q.data() + model.iq[i], *qd = x.rates(joint, model, i);
      const auto S_i = joint.subspace(q);
      const auto vJ = joint_velocity(joint, S_i, qd);

      w.Xup[i] = joint.XJ(q) * model.Xtree[i];
      w.v[i] = w.Xup[i] * w.v[p] + vJ;
      w.c[i] = crm(w.v[i], vJ) + joint.cJ(q, qd);
      w.a[i] = w.Xup[i] * w.a[p] + w.c[i] + times(S_i, slice<joint.nv>(qdd, model.iv[i]));
      w.f[i] = model.I[i] * w.a[i] + crf(w.v[i], model.I[i] * w.v[i]) - f_ext[i];
      store_subspace(S_i, w.S_.data() + model.iv[i]);
    });

  // tips to base: wrenches transmitted through the joints
  for (std::size_t i = n_bodies; i-- > 1;)
    visit_joint(model, i, [&](auto joint) {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iv = model.iv[i];
      decltype(joint.subspace(nullptr)) S_i;
      load_subspace(w.S_.data() + iv, S_i);

      auto tau = transpose_times(S_i, w.f[i]);
      for (std::size_t k = 0; k < joint.nv; ++k)
        tau[k] = tau[k] + model.armature[iv + k] * qdd[iv + k];
      store(tau, w.tau, iv);
      w.f[p] += transpose_times(w.Xup[i], w.f[i]);
    });
}

}  // namespace twinarm::TWINARM_ISA
