// Mass matrix (joint-space inertia matrix) by the composite-rigid-body algorithm, RBDA section 6.2,
// table 6.2.
//
//   Ic_p += X_i^T Ic_i X_i,   F = Ic_i S_i,   M_ii = S_i^T F + armature,
//   M_ji = M_ij^T = S_j^T F for each ancestor j of i, F transformed from body to parent on the way
//
// Writes M, nv x nv, row-major, both triangles [kg m^2, kg m, kg]. Cost O(n d), d the depth of the
// tree. Interface: solver/dynamics/dynamics.h.
#pragma once

#include <span>

#include "solver/model/joint_slice.h"
#include "solver/model/workspace.h"
#include "solver/spatial/instruction_set.h"

namespace twinarm::TWINARM_ISA {

template <class S>
[[gnu::flatten]] void crba(const Model<S>& model, const State<S>& x, Workspace<S>& w,
                           std::span<S> M) {
  const std::size_t n_bodies = model.parent.size(), nv = model.nv;
  poison_with_nan(w.Ic);
  for (std::size_t k = 0; k < nv * nv; ++k) M[k] = S(0);

  // base to tips: transforms, motion subspaces; each composite inertia starts as the body's own
  for (std::size_t i = 1; i < n_bodies; ++i)
    visit_joint(model, i, [&](auto joint) TWINARM_KERNEL {
      const S* q = x.q.data() + model.iq[i];
      w.Xup[i] = joint.XJ(q) * model.Xtree[i];
      w.Ic[i] = model.I[i];
      store_subspace(joint.subspace(q), w.S_.data() + model.iv[i]);
    });

  // tips to base: composite inertias and the blocks of M
  for (std::size_t i = n_bodies; i-- > 1;) {
    if (model.parent[i] > 0)
      add_congruence(w.Xup[i], w.Ic[i], w.Ic[static_cast<std::size_t>(model.parent[i])]);

    for (std::size_t col = model.iv[i]; col < model.iv[i] + model.dofs(i); ++col) {
      Force<S> F = w.Ic[i] * w.S_[col];
      S *const in_row = M.data() + col * nv, *const in_column = M.data() + col;
      for (std::size_t j = i; j > 0; j = static_cast<std::size_t>(model.parent[j])) {
        const std::size_t jv = model.iv[j];
        if (model.joint[j] == JointType::revolute)
          in_column[jv * nv] = in_row[jv] = F.n.z;
        else
          for (std::size_t row = jv; row < jv + model.dofs(j); ++row)
            in_column[row * nv] = in_row[row] = dot(w.S_[row], F);
        F = transpose_times(w.Xup[j], F);
      }
      in_row[col] = in_row[col] + model.armature[col];
    }
  }
}

}  // namespace twinarm::TWINARM_ISA
