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

  // From: Workspace, or a type with these members.
  template <class From>
  BodyFactors(const Model<S>& model, const From& w, std::size_t i, const std::vector<Force<S>>& U_,
              const std::vector<S>& D_factors)
      : X(convert<R>(w.Xup[i])), D(slice_spd<Joint::nv, R>(D_factors, w.iD[i])) {
    const std::size_t iv = model.iv[i];
    std::array<Motion<R>, Joint::nv> columns;
    for (std::size_t k = 0; k < Joint::nv; ++k) {
      columns[k] = convert<R>(w.S_[iv + k]);
      U[k] = convert<R>(U_[iv + k]);
    }
    load_subspace(columns.data(), S_i);
  }
};
template <class S, class F>
void visit_factors(const Model<S>& model, const Workspace<S>& w, std::size_t i, F&& f) {
  visit_joint(model, i, [&](auto joint) {
    f(joint, BodyFactors<S, S, decltype(joint)>(model, w, i, w.U, w.D_factors));
  });
}

// The joint's share of the sweep towards the base, u = b_i - S_i^T p_i, y_i = D_i^-1 u and the
// force on the parent; returns u.
template <class S, class Joint>
VecN<S, Joint::nv> carry_force(const Model<S>& model, const BodyFactors<S, S, Joint>& of,
                               std::size_t i, const std::vector<S>& b, std::vector<Force<S>>& p,
                               std::vector<S>& y) {
  const std::size_t iv = model.iv[i];
  const auto u = slice<Joint::nv>(b, iv) - transpose_times(of.S_i, p[i]);
  const auto y_i = solve(of.D, u);
  p[static_cast<std::size_t>(model.parent[i])] += transpose_times(of.X, p[i] + times(of.U, y_i));
  store(y_i, y, iv);
  return u;
}

template <class S>
[[gnu::flatten]] void minv_times(const Model<S>& model, const std::vector<S>& b,
                                 const std::vector<Force<S>>& f, Workspace<S>& w) {
  const std::size_t n_bodies = model.parent.size();
  for (std::size_t i = 0; i < n_bodies; ++i) w.p[i] = -f[i];
  for (std::size_t i = n_bodies; i-- > 1;)
    visit_factors(model, w, i,
                  [&](auto, const auto& of) { carry_force(model, of, i, b, w.p, w.y); });

  w.dv[0] = {};
  for (std::size_t i = 1; i < n_bodies; ++i)
    visit_factors(model, w, i, [&](auto joint, const auto& of) {
      const std::size_t iv = model.iv[i];
      const Motion<S> dv = of.X * w.dv[static_cast<std::size_t>(model.parent[i])];
      const auto y = slice<joint.nv>(w.y, iv) - solve(of.D, transpose_times(of.U, dv));
      w.dv[i] = dv + times(of.S_i, y);
      store(y, w.y, iv);
    });
}

}  // namespace twinarm::TWINARM_ISA
