// Inverse dynamics by the recursive Newton-Euler algorithm, RBDA section 5.3, table 5.1.
//
//   tau = M qdd + C(q, qd, f_ext),  in O(n), in body axes.
//
// Leaves w.f, the force that the parent exerts on body i through joint i, and w.tau.
#pragma once

#include "solver/slice.h"
#include "solver/workspace.h"

namespace twinarm {

template <class S>
void rnea(const Model<S>& model, const State<S>& x, const std::vector<S>& qdd,
          const std::vector<Force<S>>& f_ext, Workspace<S>& w) {
  const std::size_t n_bodies = model.parent.size();
  forget(w.v), forget(w.c), forget(w.a), forget(w.f), forget(w.tau);
  w.v[0] = {};
  w.a[0] = {{}, -model.gravity};

  // base to tips: velocities, accelerations, and the force that each body's motion needs
  for (std::size_t i = 1; i < n_bodies; ++i) {
    visit_joint<S>(model.joint[i], [&](auto joint) {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const Motion<S> vJ = times(joint.subspace, slice<joint.nv>(x.qd, model.iv[i]));

      w.Xup[i] = joint.XJ(x.q.data() + model.iq[i]) * model.Xtree[i];
      w.v[i] = w.Xup[i] * w.v[p] + vJ;
      w.c[i] = crm(w.v[i], vJ);
      w.a[i] =
          w.Xup[i] * w.a[p] + w.c[i] + times(joint.subspace, slice<joint.nv>(qdd, model.iv[i]));
      w.f[i] = model.I[i] * w.a[i] + crf(w.v[i], model.I[i] * w.v[i]) - f_ext[i];
    });
  }

  // tips to base: forces through the joints
  for (std::size_t i = n_bodies; i-- > 1;) {
    visit_joint<S>(model.joint[i], [&](auto joint) {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      store(transpose_times(joint.subspace, w.f[i]), w.tau, model.iv[i]);
      if (p > 0) w.f[p] += transpose_times(w.Xup[i], w.f[i]);
    });
  }
}

extern template void rnea(const Model<double>&, const State<double>&, const std::vector<double>&,
                          const std::vector<Force<double>>&, Workspace<double>&);

}  // namespace twinarm
