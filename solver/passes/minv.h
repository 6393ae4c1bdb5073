// y = M^-1 (b + J^T f) in O(n): passes 2 and 3 of ABA with zero velocity and no gravity.
//
//   tips to base   u_i = b_i - S_i^T p_i,   y_i = D_i^-1 u_i,   p_p += X_i^T (p_i + U_i y_i)
//   base to tips   y_i -= D_i^-1 U_i^T X_i dv_p,   dv_i = X_i dv_p + S_i y_i
//
// f: wrenches on bodies, body axes; p_i starts as -f_i. Reads Xup, U and D_factors of aba() at the
// same q; M therefore contains the implicit terms of that call. Writes y and dv, the spatial
// accelerations of the bodies for qdd = y. Interface: solver/dynamics/dynamics.h.
#pragma once

#include "solver/model/joint_slice.h"
#include "solver/model/workspace.h"
#include "solver/spatial/convert_spatial.h"
#include "solver/spatial/instruction_set.h"

namespace twinarm::TWINARM_ISA {

// X, S, U and D_factors of a body for right-hand sides of R: S itself, or lanes that share them.
template <class R, class S, class Joint>
struct BodyFactors {
  Transform<R> X;
  decltype(std::declval<Joint>().subspace(nullptr)) S_i;
  std::array<Force<R>, Joint::nv> U;
  Spd<R, Joint::nv> D;

  BodyFactors(const Model<S>& model, const Workspace<S>& w, std::size_t i)
      : X(convert<R>(w.Xup[i])), D(slice_spd<Joint::nv, R>(w.D_factors, w.iD[i])) {
    const std::size_t iv = model.iv[i];
    std::array<Motion<R>, Joint::nv> columns;
    for (std::size_t k = 0; k < Joint::nv; ++k) {
      columns[k] = convert<R>(w.S_[iv + k]);
      U[k] = convert<R>(w.U[iv + k]);
    }
    load_subspace(columns.data(), S_i);
  }
};
template <class R, class S, class F>
void visit_factors(const Model<S>& model, const Workspace<S>& w, std::size_t i, F&& f) {
  visit_joint<R>(model.joint[i], R(model.pitch[i]),
                 [&](auto joint) { f(joint, BodyFactors<R, S, decltype(joint)>(model, w, i)); });
}

template <class S, class R>
void minv_sweeps(const Model<S>& model, const Workspace<S>& w, const std::vector<R>& b,
                 std::vector<Force<R>>& p, std::vector<Motion<R>>& dv, std::vector<R>& y) {
  const std::size_t n_bodies = model.parent.size();
  for (std::size_t i = n_bodies; i-- > 1;)
    visit_factors<R>(model, w, i, [&](auto joint, const auto& of) {
      const std::size_t iv = model.iv[i];
      const auto u = slice<joint.nv>(b, iv) - transpose_times(of.S_i, p[i]);
      const auto y_i = solve(of.D, u);
      p[static_cast<std::size_t>(model.parent[i])] +=
          transpose_times(of.X, p[i] + times(of.U, y_i));
      store(y_i, y, iv);
    });

  dv[0] = {};
  for (std::size_t i = 1; i < n_bodies; ++i)
    visit_factors<R>(model, w, i, [&](auto joint, const auto& of) {
      const std::size_t iv = model.iv[i];
      const Motion<R> dv_i = of.X * dv[static_cast<std::size_t>(model.parent[i])];
      const auto y_i = slice<joint.nv>(y, iv) - solve(of.D, transpose_times(of.U, dv_i));
      dv[i] = dv_i + times(of.S_i, y_i);
      store(y_i, y, iv);
    });
}

template <class S>
[[gnu::flatten]] void minv_times(const Model<S>& model, const std::vector<S>& b,
                                 const std::vector<Force<S>>& f, Workspace<S>& w) {
  for (std::size_t i = 0; i < f.size(); ++i) w.p[i] = -f[i];
  minv_sweeps(model, w, b, w.p, w.dv, w.y);
}

// Several b at once, without f.
template <class S, class R>
[[gnu::flatten]] void minv_times_lanes(const Model<S>& model, const Workspace<S>& w,
                                       RightHandSides<R>& r) {
  std::ranges::fill(r.p, Force<R>{});
  minv_sweeps(model, w, r.b, r.p, r.dv, r.y);
}

}  // namespace twinarm::TWINARM_ISA
