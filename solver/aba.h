// Forward dynamics by the articulated-body algorithm, RBDA section 7.3, table 7.1.
//
//   qdd = M^-1 (tau - C(q, qd, f_ext)),  in O(n).
//
// All quantities in body axes. Two inputs beyond the book, both for implicit spring-dampers
// (docs/coupling.md): forces.armature is added to D, forces.impedance to IA, and neither to
// anything else.
#pragma once

#include "solver/slice.h"
#include "solver/workspace.h"

namespace twinarm {

template <class S>
void aba(const Model<S>& model, const State<S>& x, const Forces<S>& forces, Workspace<S>& w) {
  const std::size_t n_bodies = model.parent.size();
  forget(w.v), forget(w.c), forget(w.IA), forget(w.pA), forget(w.a), forget(w.qdd);
  w.v[0] = {};
  w.a[0] = {{}, -model.gravity};  // gravity as an upward acceleration of the base

  // pass 1, base to tips: velocities, velocity-product terms, inertias and bias forces of each body
  for (std::size_t i = 1; i < n_bodies; ++i) {
    visit_joint<S>(model.joint[i], [&](auto joint) {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const Motion<S> vJ = times(joint.subspace, slice<joint.nv>(x.qd, model.iv[i]));

      w.Xup[i] = joint.XJ(x.q.data() + model.iq[i]) * model.Xtree[i];
      w.v[i] = w.Xup[i] * w.v[p] + vJ;
      w.c[i] = crm(w.v[i], vJ);
      w.IA[i] = ArticulatedInertia<S>(model.I[i]) + forces.impedance[i];
      w.pA[i] = crf(w.v[i], model.I[i] * w.v[i]) - forces.f_ext[i];
    });
  }

  // pass 2, tips to base: articulated-body inertias and bias forces
  for (std::size_t i = n_bodies; i-- > 1;) {
    visit_joint<S>(model.joint[i], [&](auto joint) {
      constexpr auto subspace = joint.subspace;
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iv = model.iv[i];

      const auto U = w.IA[i] * subspace;
      const auto D = plus_diagonal(transpose_times(subspace, U), forces.armature, iv);
      const auto Dinv = inverse_spd(D);
      const auto u = minus(slice<joint.nv>(forces.tau, iv), transpose_times(subspace, w.pA[i]));
      if (p > 0) {
        const ArticulatedInertia<S> Ia = w.IA[i] - congruence(U, Dinv);
        const Force<S> pa = w.pA[i] + Ia * w.c[i] + times(U, Dinv * u);
        w.IA[p] += congruence(w.Xup[i], Ia);
        w.pA[p] += transpose_times(w.Xup[i], pa);
      }
      store(U, w.U, iv);
      store(u, w.u, iv);
      store_matrix(D, w.D, w.iD[i]);
      store_matrix(Dinv, w.Dinv, w.iD[i]);
    });
  }

  // pass 3, base to tips: accelerations
  for (std::size_t i = 1; i < n_bodies; ++i) {
    visit_joint<S>(model.joint[i], [&](auto joint) {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iv = model.iv[i];
      const auto U = slice<joint.nv>(w.U, iv);
      const auto u = slice<joint.nv>(w.u, iv);
      const auto Dinv = slice_matrix<joint.nv>(w.Dinv, w.iD[i]);

      const Motion<S> a = w.Xup[i] * w.a[p] + w.c[i];
      const auto qdd = Dinv * minus(u, transpose_times(U, a));
      w.a[i] = a + times(joint.subspace, qdd);
      store(qdd, w.qdd, iv);
    });
  }
}

extern template void aba(const Model<double>&, const State<double>&, const Forces<double>&,
                         Workspace<double>&);

}  // namespace twinarm
