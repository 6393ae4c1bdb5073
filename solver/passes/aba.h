// Forward dynamics by the articulated-body algorithm (ABA), RBDA section 7.3, table 7.1.
//
//   qdd = M^-1 (tau - C(q, qd, f_ext)),  in O(n).
//
//   pass 1   v_i = X_i v_p + S_i qd_i,   c_i = cJ_i + v_i x S_i qd_i,
//            p_i = v_i x* I_i v_i - f_ext_i
//   pass 2   U_i = IA_i S_i,   D_i = S_i^T U_i,   u_i = tau_i - S_i^T pA_i,
//            Ia = IA_i - U_i D_i^-1 U_i^T,   pa = pA_i + Ia c_i + U_i D_i^-1 u_i,
//            IA_p += X_i^T Ia X_i,   pA_p += X_i^T pa
//   pass 3   a' = X_i a_p + c_i,   qdd_i = D_i^-1 (u_i - U_i^T a'),   a_i = a' + S_i qdd_i
//
// X_i (Xup) transforms motion vectors from parent p to body i. All quantities are in body axes,
// about the body's origin. Added to the book's algorithm: rotor inertia (model.armature) on the
// diagonal of D; for implicit spring-dampers (docs/understand/coupling_laws.md) forces.armature on
// the diagonal of D and forces.added_inertia in IA. Interface: solver/dynamics/dynamics.h.
#pragma once

#include "solver/model/joint_slice.h"
#include "solver/model/trace.h"
#include "solver/model/workspace.h"
#include "solver/spatial/instruction_set.h"
#include "solver/spatial/sincos_batch.h"

namespace twinarm::TWINARM_ISA {

// M: Model<S> or a type with the same members.
template <class S, class M, class Trace = NoTrace>
[[gnu::flatten]] void aba(const M& model, const State<S>& x, const Forces<S>& forces,
                          Workspace<S>& w, Trace&& trace = {}) {
  const std::size_t n_bodies = model.parent.size();
  poison_with_nan(w.v, w.c, w.IA, w.pA, w.a, w.qdd);
  w.v[0] = {};
  w.a[0] = {{}, -model.gravity};  // gravity as a fictitious acceleration of the base, a_0 = -a_g
  precompute_sincos(x.q, w.sin, w.cos);

  // pass 1, base to tips: velocity, velocity-product acceleration and bias force of each body
  for (std::size_t i = 1; i < n_bodies; ++i)
    visit_joint(model, i, [&](auto joint) {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iq = model.iq[i];
      const S *q = x.q.data() + iq, *qd = x.rates(joint, model, i);
      const auto S_i = joint.subspace(q);
      const auto vJ = joint_velocity(joint, S_i, qd);

      w.Xup[i] = joint_transform(joint, q, w.sin.data() + iq, w.cos.data() + iq) * model.Xtree[i];
      w.v[i] = w.Xup[i] * w.v[p] + vJ;
      w.c[i] = crm(w.v[i], vJ) + joint.cJ(q, qd);
      w.pA[i] = crf(w.v[i], model.I[i] * w.v[i]) - forces.f_ext[i];
      store_subspace(S_i, w.S_.data() + model.iv[i]);
    });
  trace.after_pass_1();

  // pass 2, tips to base: articulated-body inertia and articulated-body bias force
  for (std::size_t i = n_bodies; i-- > 1;) {
    if (model.last_child[i] == 0) w.IA[i] = model.I[i];  // leaf; others are set by their last child
    if (forces.has_added_inertia) w.IA[i] += forces.added_inertia[i];
    visit_joint(model, forces.armature, i, [&](auto joint, auto sparsity) TWINARM_KERNEL {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iv = model.iv[i];
      decltype(joint.subspace(nullptr)) S_i;
      load_subspace(w.S_.data() + iv, S_i);

      const auto U = w.IA[i] * S_i;
      auto D = transpose_times(S_i, U);
      add_to_diagonal(D, model.armature, forces.armature, iv);
      bool is_known = false;  // a free body that keeps its axes has the D of the last step
      if constexpr (joint.nv == 6 && std::is_same_v<S, double>)
        is_known = is_stored(D, w.D, w.iD[i]);
      const auto factors = is_known ? slice_spd<joint.nv, S>(w.D_factors, w.iD[i]) : factorized(D);
      const auto u = slice<joint.nv>(forces.tau, iv) - transpose_times(S_i, w.pA[i]);
      if (p > 0) {
        const auto Ia = apparent_inertia(sparsity, w.IA[i], U, factors);  // IA - U D^-1 U^T
        const Force<S> pa = w.pA[i] + Ia * w.c[i] + times(U, solve(factors, u));
        w.pA[p] += transpose_times(w.Xup[i], pa);
        if (model.last_child[p] == static_cast<int>(i))  // IA_p = I_p + X^T Ia X
          add_congruence(w.Xup[i], Ia, ArticulatedInertia<S>(model.I[p]), w.IA[p]);
        else  // IA_p += X^T Ia X
          add_congruence(w.Xup[i], Ia, w.IA[p], w.IA[p]);
        trace.transmitted(i, Ia, pa);
      }
      store(U, w.U, iv), store(D, w.D, w.iD[i]);
      store(factors, w.D_factors, w.iD[i]), store(u, w.u, iv);
    });
  }

  // pass 3, base to tips: joint accelerations and spatial accelerations
  for (std::size_t i = 1; i < n_bodies; ++i)
    visit_joint(model, i, [&](auto joint) {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iv = model.iv[i];
      decltype(joint.subspace(nullptr)) S_i;
      load_subspace(w.S_.data() + iv, S_i);

      const Motion<S> a = w.Xup[i] * w.a[p] + w.c[i];
      const auto r = slice<joint.nv>(w.u, iv) - transpose_times(slice<joint.nv>(w.U, iv), a);
      const auto qdd = solve(slice_spd<joint.nv, S>(w.D_factors, w.iD[i]), r);
      w.a[i] = a + times(S_i, qdd);
      store(qdd, w.qdd, iv);
    });
}

}  // namespace twinarm::TWINARM_ISA
