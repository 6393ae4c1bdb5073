// M^-1 as a matrix, in O(n d) and O(n^2) for its entries: Carpentier (2018).
//
// Row i of the upper triangle is the acceleration of joint i for a unit force at each joint j >= i.
// As in minv_times(), pass 2 of ABA carries the wrenches F of all unit forces in the subtree to its
// root, pass 3 the accelerations P of the bodies to the tips:
//
//   tips to base, for j below i
//     M^-1_ii = D_i^-1,   M^-1_ij = -D_i^-1 S_i^T F_j,   F_j += U_i M^-1_ij
//   base to tips, for all j >= i
//     M^-1_ij -= D_i^-1 U_i^T P_j,   P_j += S_i M^-1_ij
//
// In the axes of Workspace::Xr, F and P are not transformed from body to body, and each is a row of
// numbers. M contains model.armature. Writes Minv, nv x nv, row-major, both triangles. Interface:
// solver/dynamics/dynamics.h.
#pragma once

#include <span>

#include "solver/model/joint_slice.h"
#include "solver/model/matrix_workspace.h"
#include "solver/passes/dense_matrix.h"
#include "solver/spatial/sincos_batch.h"

namespace twinarm::TWINARM_ISA {

// Passes 1 and 2 of ABA as far as they depend on q alone: Xup, S, IA, U and D_factors.
template <class S>
void articulated_inertias(const Model<S>& model, const State<S>& x, Workspace<S>& w,
                          const MatrixWorkspace<S>& m) {
  precompute_sincos(x.q, w.sin, w.cos);
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    visit_joint(model, i, [&](auto joint) {
      const std::size_t iq = model.iq[i];
      const S* q = x.q.data() + iq;
      w.Xup[i] = joint_transform(joint, q, w.sin.data() + iq, w.cos.data() + iq) * model.Xtree[i];
      store_subspace(joint.subspace(q), w.S_.data() + model.iv[i]);
    });
  for (std::size_t i = model.parent.size(); i-- > 1;) {
    if (model.last_child[i] == 0) w.IA[i] = model.I[i];
    visit_joint(model, m.no_armature, i, [&](auto joint, auto sparsity) TWINARM_KERNEL {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iv = model.iv[i];
      decltype(joint.subspace(nullptr)) S_i;
      load_subspace(w.S_.data() + iv, S_i);
      const auto U = w.IA[i] * S_i;
      auto D = transpose_times(S_i, U);
      add_to_diagonal(D, model.armature, m.no_armature, iv);
      const auto factors = factorized(D);
      store(U, w.U, iv), store(D, w.D, w.iD[i]), store(factors, w.D_factors, w.iD[i]);
      if (p == 0) return;
      const auto Ia = apparent_inertia(sparsity, w.IA[i], U, factors);
      if (model.last_child[p] == static_cast<int>(i))
        add_congruence(w.Xup[i], Ia, ArticulatedInertia<S>(model.I[p]), w.IA[p]);
      else
        add_congruence(w.Xup[i], Ia, w.IA[p], w.IA[p]);
    });
  }
}

// The factors in the common axes, and the diagonal blocks of M^-1.
template <class S>
void factors_in_common_axes(const Model<S>& model, Workspace<S>& w, MatrixWorkspace<S>& m,
                            std::span<S> Minv) {
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    visit_joint(model, i, [&](auto joint) {
      const Transform<S> X = place(model, i, w);
      const std::size_t iv = model.iv[i];
      std::array<Motion<S>, joint.nv> axes;
      std::array<Force<S>, joint.nv> U;
      for (std::size_t k = 0; k < joint.nv; ++k) {
        m.S_[iv + k] = six(axes[k] = to_common_axes(X, w.S_[iv + k]));
        m.U[iv + k] = six(U[k] = transpose_times(X, w.U[iv + k]));
      }
      const auto factors = slice_spd<joint.nv, S>(w.D_factors, w.iD[i]);
      for (std::size_t r = 0; r < joint.nv; ++r) {
        const auto Dinv = solve(factors, unit_vector<S, joint.nv>(r));
        Motion<S> DinvS;
        Force<S> DinvU;
        for (std::size_t k = 0; k < joint.nv; ++k) {
          Minv[(iv + r) * model.nv + iv + k] = Dinv[k];
          DinvS += Dinv[k] * axes[k];
          DinvU += Dinv[k] * U[k];
        }
        m.DinvS[iv + r] = six(DinvS);
        m.DinvU[iv + r] = six(DinvU);
      }
    });
}

// Reads Xup, S, U and D_factors, of aba() with the implicit terms of that call.
template <class S>
[[gnu::flatten]] void minv_of_factors(const Model<S>& model, Workspace<S>& w, MatrixWorkspace<S>& m,
                                      std::span<S> Minv) {
  const std::size_t n_bodies = model.parent.size(), nv = model.nv;
  std::ranges::fill(Minv, S(0));
  factors_in_common_axes(model, w, m, Minv);

  const auto F = m.F.pointers();
  for (std::size_t i = n_bodies; i-- > 1;) {
    const DofRange own{model.iv[i], model.iv[i] + model.dofs(i)};
    for (std::size_t r = own.first; r < own.end; ++r)
      for (const DofRange& below : m.below[i]) {
        S* const row = &Minv[r * nv];
        const Six<S> DinvS = m.DinvS[r];
        TWINARM_INDEPENDENT
        for (std::size_t j = below.first; j < below.end; ++j) row[j] = -dot(DinvS, F, j);
      }
    if (model.parent[i] == 0) continue;
    for (std::size_t j = own.first; j < own.end; ++j) m.F.set(j, {});
    for (std::size_t r = own.first; r < own.end; ++r) {
      add_outer(m.U[r], &Minv[r * nv], own, F);
      for (const DofRange& below : m.below[i]) add_outer(m.U[r], &Minv[r * nv], below, F);
    }
  }

  for (std::size_t i = 1; i < n_bodies; ++i) {
    const auto p = static_cast<std::size_t>(model.parent[i]);
    const std::size_t first = model.iv[i], end = first + model.dofs(i);
    if (p > 0) {
      const auto P = m.P[m.iP[p]].pointers();
      for (std::size_t r = first; r < end; ++r) {
        S* const row = &Minv[r * nv];
        const Six<S> DinvU = m.DinvU[r];
        TWINARM_INDEPENDENT
        for (std::size_t j = first; j < nv; ++j) row[j] = row[j] - dot(DinvU, P, j);
      }
    }
    if (model.last_child[i] == 0) continue;
    SpatialRows<S>& P = m.P[m.iP[i]];
    if (p == 0)
      for (std::size_t j = end; j < nv; ++j) P.set(j, {});
    else if (m.iP[i] != m.iP[p])
      P = m.P[m.iP[p]];
    for (std::size_t r = first; r < end; ++r)
      add_outer(m.S_[r], &Minv[r * nv], {end, nv}, P.pointers());
  }
  mirror_triangle<Triangle::upper>(nv, Minv.data());
}

template <class S>
[[gnu::flatten]] void minv_matrix(const Model<S>& model, const State<S>& x, Workspace<S>& w,
                                  MatrixWorkspace<S>& m, std::span<S> Minv) {
  articulated_inertias(model, x, w, m);
  minv_of_factors(model, w, m, Minv);
}

}  // namespace twinarm::TWINARM_ISA
