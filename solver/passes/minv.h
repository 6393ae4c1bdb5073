// y = M^-1 (b + J^T f) in O(n): passes 2 and 3 of ABA with zero velocity and no gravity.
//
//   tips to base   u_i = b_i - S_i^T p_i,   y_i = D_i^-1 u_i,   p_p += X_i^T (p_i + U_i y_i)
//   base to tips   y_i -= D_i^-1 U_i^T X_i dv_p,   dv_i = X_i dv_p + S_i y_i
//
// f: wrenches on bodies, body axes; p_i starts as -f_i. Reads Xup, U and D_factors of aba() at the
// same q; M therefore contains the implicit terms of that call. Writes w.y and w.dv, the spatial
// accelerations of the bodies for qdd = y. Interface: solver/dynamics/dynamics.h.
#pragma once

#include "solver/model/joint_slice.h"
#include "solver/model/workspace.h"
#include "solver/spatial/instruction_set.h"

namespace twinarm::TWINARM_ISA {

template <class S>
[[gnu::flatten]] void minv_times(const Model<S>& model, const std::vector<S>& b,
                                 const std::vector<Force<S>>& f, Workspace<S>& w) {
  const std::size_t n_bodies = model.parent.size();
  for (std::size_t i = 0; i < n_bodies; ++i) w.p[i] = -f[i];

  for (std::size_t i = n_bodies; i-- > 1;)
    visit_joint(model, i, [&](auto joint) {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iv = model.iv[i];
      decltype(joint.subspace(nullptr)) S_i;
      load_subspace(w.S_.data() + iv, S_i);
      const auto u = slice<joint.nv>(b, iv) - transpose_times(S_i, w.p[i]);
      const auto y = solve(slice_spd<joint.nv>(w.D_factors, w.iD[i]), u);
      w.p[p] += transpose_times(w.Xup[i], w.p[i] + times(slice<joint.nv>(w.U, iv), y));
      store(y, w.y, iv);
    });

  w.dv[0] = {};
  for (std::size_t i = 1; i < n_bodies; ++i)
    visit_joint(model, i, [&](auto joint) {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iv = model.iv[i];
      decltype(joint.subspace(nullptr)) S_i;
      load_subspace(w.S_.data() + iv, S_i);
      const Motion<S> dv = w.Xup[i] * w.dv[p];
      const auto Ut_dv = transpose_times(slice<joint.nv>(w.U, iv), dv);
      const auto factors = slice_spd<joint.nv>(w.D_factors, w.iD[i]);
      const auto y = slice<joint.nv>(w.y, iv) - solve(factors, Ut_dv);
      w.dv[i] = dv + times(S_i, y);
      store(y, w.y, iv);
    });
}

}  // namespace twinarm::TWINARM_ISA
