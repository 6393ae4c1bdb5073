// M^-1 (b + J^T f) in O(n): the second and third pass of ABA, at rest and without gravity.
//
// f are forces on bodies, in body axes; for M^-1 b alone they are zero. Uses Xup, U, D_factors that
// aba() left for the same q (with its implicit terms: M is what aba() solved with). Writes w.y, and
// w.dv, the accelerations of the bodies that go with it. Callers include
// solver/dynamics/dynamics.h.
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

  for (std::size_t i = n_bodies; i-- > 1;) {
    visit_joint(model, i, [&](auto joint) {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iv = model.iv[i];
      decltype(joint.subspace(nullptr)) S_i;
      recall(w.S_.data() + iv, S_i);
      const auto u = slice<joint.nv>(b, iv) - transpose_times(S_i, w.p[i]);
      const auto y = solve(slice_spd<joint.nv>(w.D_factors, w.iD[i]), u);
      w.p[p] += transpose_times(w.Xup[i], w.p[i] + times(slice<joint.nv>(w.U, iv), y));
      store(y, w.y, iv);  // D^-1 u
    });
  }

  w.dv[0] = {};
  for (std::size_t i = 1; i < n_bodies; ++i) {
    visit_joint(model, i, [&](auto joint) {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iv = model.iv[i];
      decltype(joint.subspace(nullptr)) S_i;
      recall(w.S_.data() + iv, S_i);
      const Motion<S> dv = w.Xup[i] * w.dv[p];
      const auto felt = transpose_times(slice<joint.nv>(w.U, iv), dv);
      const auto factors = slice_spd<joint.nv>(w.D_factors, w.iD[i]);
      const auto y = slice<joint.nv>(w.y, iv) - solve(factors, felt);
      w.dv[i] = dv + times(S_i, y);
      store(y, w.y, iv);
    });
  }
}

}  // namespace twinarm::TWINARM_ISA
