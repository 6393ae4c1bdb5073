// Forward dynamics by the articulated-body algorithm, RBDA section 7.3, table 7.1.
//
//   qdd = M^-1 (tau - C(q, qd, f_ext)),  in O(n).
//
// All quantities in body axes. Inputs beyond the book: the rotors' armature is added to D; and for
// implicit spring-dampers (docs/understand/coupling_laws.md) forces.armature to D, forces.impedance
// to IA, and neither to anything else. Callers include solver/dynamics/dynamics.h.
#pragma once

#include "solver/model/joint_slice.h"
#include "solver/model/trace.h"
#include "solver/model/workspace.h"
#include "solver/spatial/instruction_set.h"
#include "solver/spatial/sincos_batch.h"

namespace twinarm::TWINARM_ISA {

// M: a Model<S>, or a type with its members.
template <class S, class M, class Trace = NoTrace>
[[gnu::flatten]] void aba(const M& model, const State<S>& x, const Forces<S>& forces,
                          Workspace<S>& w, Trace&& trace = {}) {
  const std::size_t n_bodies = model.parent.size();
  forget(w.v), forget(w.c), forget(w.IA), forget(w.pA), forget(w.a), forget(w.qdd);
  w.v[0] = {};
  w.a[0] = {{}, -model.gravity};  // gravity as an upward acceleration of the base
  precompute_sincos(x.q, w.sin, w.cos);

  // pass 1, base to tips: velocities, velocity-product terms, inertias and bias forces of each body
  for (std::size_t i = 1; i < n_bodies; ++i) {
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
      remember(S_i, w.S_.data() + model.iv[i]);
    });
  }
  trace.moved();

  // pass 2, tips to base: articulated-body inertias and bias forces
  for (std::size_t i = n_bodies; i-- > 1;) {
    if (model.last_child[i] == 0) w.IA[i] = model.I[i];  // a tip; others begin at their last child
    if (forces.has_impedance) w.IA[i] += forces.impedance[i];
    visit_joint(model, forces.armature, i, [&](auto joint, auto felt) TWINARM_KERNEL {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iv = model.iv[i];
      decltype(joint.subspace(nullptr)) S_i;
      recall(w.S_.data() + iv, S_i);

      const auto U = w.IA[i] * S_i;
      auto D = transpose_times(S_i, U);
      add_to_diagonal(D, model.armature, forces.armature, iv);
      const auto factors = factorized(D);
      const auto u = slice<joint.nv>(forces.tau, iv) - transpose_times(S_i, w.pA[i]);
      if (p > 0) {
        const auto Ia = apparent_inertia(felt, w.IA[i], U, factors);  // IA - U D^-1 U^T
        const Force<S> pa = w.pA[i] + Ia * w.c[i] + times(U, solve(factors, u));
        w.pA[p] += transpose_times(w.Xup[i], pa);
        if (model.last_child[p] == static_cast<int>(i))  // IA_p = I_p + X^T Ia X
          add_congruence(w.Xup[i], Ia, ArticulatedInertia<S>(model.I[p]), w.IA[p]);
        else  // IA_p += X^T Ia X
          add_congruence(w.Xup[i], Ia, w.IA[p], w.IA[p]);
        trace.felt(i, Ia, pa);
      }
      store(U, w.U, iv), store(D, w.D, w.iD[i]);
      store(factors, w.D_factors, w.iD[i]), store(u, w.u, iv);
    });
  }

  // pass 3, base to tips: accelerations
  for (std::size_t i = 1; i < n_bodies; ++i) {
    visit_joint(model, i, [&](auto joint) {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iv = model.iv[i];
      decltype(joint.subspace(nullptr)) S_i;
      recall(w.S_.data() + iv, S_i);

      const Motion<S> a = w.Xup[i] * w.a[p] + w.c[i];
      const auto r = slice<joint.nv>(w.u, iv) - transpose_times(slice<joint.nv>(w.U, iv), a);
      const auto qdd = solve(slice_spd<joint.nv>(w.D_factors, w.iD[i]), r);
      w.a[i] = a + times(S_i, qdd);
      store(qdd, w.qdd, iv);
    });
  }
}

}  // namespace twinarm::TWINARM_ISA
