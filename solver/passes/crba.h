// Mass matrix (joint-space inertia matrix) by the composite-rigid-body algorithm, RBDA section 6.2,
// table 6.2.
//
//   Ic_p += X_i^T Ic_i X_i,   F = Ic_i S_i,   M_ii = S_i^T F + armature,
//   M_ji = M_ij^T = S_j^T F for each ancestor j of i, F transformed from body to parent on the way
//
// Two forms of one result. crba_in_body_axes, as above; crba_in_common_axes for deep trees
// (ModelTree::is_deep): in the axes that all bodies of a tree share (Workspace::Xr), I^c are sums
// without transforms, F stays as it is, and a row of M is F^T times the S of all ancestors.
//
// Writes M, nv x nv, row-major, both triangles [kg m^2, kg m, kg]. Cost O(n d), d the depth of the
// tree. Interface: solver/dynamics/dynamics.h.
#pragma once

#include <algorithm>
#include <span>

#include "solver/model/joint_slice.h"
#include "solver/model/workspace.h"
#include "solver/passes/dense_matrix.h"
#include "solver/spatial/instruction_set.h"

namespace twinarm::TWINARM_ISA {

template <class S>
[[gnu::flatten]] void crba_in_body_axes(const Model<S>& model, const State<S>& x, Workspace<S>& w,
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

    visit_joint(model, i, [&](auto joint) TWINARM_KERNEL {
      for (std::size_t k = 0; k < joint.nv; ++k) {
        const std::size_t col = model.iv[i] + k;
        Force<S> F = w.Ic[i] * w.S_[col];
        if constexpr (joint.S_is_constant)  // S has unit columns: F is a column of Ic
          F = (ArticulatedInertia<S>(w.Ic[i]) * joint.subspace(nullptr))[k];
        S *const in_row = M.data() + col * nv, *const in_column = M.data() + col;
        for (std::size_t j = i;;) {
          const std::size_t jv = model.iv[j];
          if (model.joint[j] == JointType::revolute)
            in_column[jv * nv] = in_row[jv] = F.n.z;
          else
            for (std::size_t row = jv; row < jv + model.dofs(j); ++row)
              in_column[row * nv] = in_row[row] = dot(w.S_[row], F);
          const auto p = static_cast<std::size_t>(model.parent[j]);
          if (p == 0) break;
          F = transpose_times(w.Xup[j], F);
          j = p;
        }
        in_row[col] = in_row[col] + model.armature[col];
      }
    });
  }
}

template <class S>
[[gnu::flatten]] void crba_in_common_axes(const Model<S>& model, const State<S>& x, Workspace<S>& w,
                                          std::span<S> M) {
  const std::size_t n_bodies = model.parent.size(), nv = model.nv;

  // base to tips: transforms, and motion subspaces and inertias in common axes
  for (std::size_t i = 1; i < n_bodies; ++i)
    visit_joint(model, i, [&](auto joint) TWINARM_KERNEL {
      const S* q = x.q.data() + model.iq[i];
      w.Xup[i] = joint.XJ(q) * model.Xtree[i];
      const Transform<S> X = place(model, i, w);
      w.Ic[i] = {};
      add_congruence(X, model.I[i], w.Ic[i]);
      store_subspace(joint.subspace(q), w.S_.data() + model.iv[i]);
      for (std::size_t k = model.iv[i]; k < model.iv[i] + joint.nv; ++k)
        w.axes.set(k, six(to_common_axes(X, w.S_[k])));
    });

  // tips to base: composite inertias and the rows of M
  const auto axes = w.axes.pointers();
  for (std::size_t i = n_bodies; i-- > 1;) {
    const DofRange own{model.iv[i], model.iv[i] + model.dofs(i)};
    for (std::size_t k = own.first; k < own.end; ++k) {
      const Six<S> F = six(w.Ic[i] * w.axes.motion(k));
      S* const row = M.data() + k * nv;
      const auto products = [&](const DofRange& of) {
        TWINARM_INDEPENDENT
        for (std::size_t j = of.first; j < of.end; ++j) row[j] = dot(F, axes, j);
      };
      products({own.first, k + 1});
      std::size_t done = own.first;  // M is 0 between the ranges
      visit_ancestors(model, i, [&](const DofRange& of) {
        std::fill(row + of.end, row + done, S(0));
        products(of);
        done = of.first;
      });
      std::fill(row, row + done, S(0));
      row[k] = row[k] + model.armature[k];
    }
    if (model.parent[i] > 0) w.Ic[static_cast<std::size_t>(model.parent[i])] += w.Ic[i];
  }
  mirror_triangle<Triangle::lower>(nv, M.data());
}

}  // namespace twinarm::TWINARM_ISA
