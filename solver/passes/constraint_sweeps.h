// Constraints within the articulated-body recursion: the recursion of Popov and Vereshchagin with
// early elimination (Sathya and Carpentier, Constrained Articulated Body Dynamics Algorithms).
//
//   M y = b + A^T lambda,   A y = s
// A row with entries E_i in joint i is carried from the tips to the base as K_i a_i on the spatial
// acceleration of body i, together with what follows from the joints below:
//   tips to base   L = K_i S_i + E_i,   u_i = b_i - S_i^T p_i,
//                  G += L D_i^-1 L^T,   K_p += (K_i - L D_i^-1 U_i^T) X_i,
//                  s -= L D_i^-1 u_i,   p_p += X_i^T (p_i + U_i D_i^-1 u_i)
//   base to tips   y_i = D_i^-1 (u_i - U_i^T X_i dv_p + L^T lambda),   dv_i = X_i dv_p + S_i y_i
// At the body where all entries of a row have been seen, solver/loops/constraint_elimination.h
// eliminates its lambda, which adds dIA to IA there; U and D of that body and its ancestors change.
// A held joint has D^-1 = 0. Reads Xup, S, U, D and D_factors of aba() at the same q; body axes.
// S is double.
#pragma once

#include "solver/model/constraint_workspace.h"
#include "solver/passes/minv.h"

namespace twinarm::TWINARM_ISA {

// U and D with dIA; the increase of IA of the parent.
template <class Joint, class S>
void change_factors(Joint joint, const Model<S>& model, const Workspace<S>& w,
                    ConstraintWorkspace& c, std::size_t i) {
  const auto p = static_cast<std::size_t>(model.parent[i]);
  const std::size_t iv = model.iv[i];
  const BodyFactors<S, S, Joint> of(model, w, i, w.U, w.D_factors);
  auto U = c.dIA[i] * of.S_i;
  auto D = transpose_times(of.S_i, U);
  for (std::size_t k = 0; k < joint.nv; ++k) {
    U[k] += of.U[k];
    for (std::size_t l = 0; l < joint.nv; ++l) D[k][l] += w.D[w.iD[i] + k * joint.nv + l];
  }
  for (std::size_t k = 0; k < joint.nv; ++k)
    for (std::size_t l = 0; l < joint.nv; ++l)
      if (c.is_held[iv + k] || c.is_held[iv + l]) D[k][l] = k == l;
  auto factors = factorized(D);
  for (std::size_t k = 0; k < joint.nv; ++k)
    if (c.is_held[iv + k]) factors.inverse_d[k] = 0;
  if (p > 0)
    c.add_inertia(p, w.Xup[i],
                  subtract_rank_n(c.dIA[i], U, factors) - subtract_rank_n({}, of.U, of.D));
  store(U, c.f.changed_U, iv), store(factors, c.f.changed_D, w.iD[i]);
}

template <class R, class S, class F>
void visit_factors(const Model<S>& model, const ConstraintWorkspace::Factors& c, std::size_t i,
                   F&& f) {
  visit_joint<R>(model.joint[i], R(model.pitch[i]), [&](auto joint) {
    const bool changed = c.is_changed[i];
    f(joint, BodyFactors<R, S, decltype(joint)>(model, c, i, changed ? c.changed_U : c.U,
                                                changed ? c.changed_D : c.D_factors));
  });
}

// K, G and the factors of the bodies from first to before end.
template <class S>
[[gnu::flatten]] void constraint_factors(const Model<S>& model, const Workspace<S>& w,
                                         ConstraintWorkspace& c, std::size_t first,
                                         std::size_t end) {
  using Rows = ConstraintWorkspace::Rows;
  for (std::size_t i = end; i-- > first;) {
    if (c.f.is_changed[i])
      visit_joint(model, i, [&](auto joint) { change_factors(joint, model, w, c, i); });
    const ConstraintWorkspace::Front& front = c.fronts[i];
    if (front.open == 0) continue;
    visit_factors<Rows>(model, c.f, i, [&](auto joint, const auto& of) {
      constexpr std::size_t nv = joint.nv;
      for (std::size_t j = 0; j < front.open; ++j) {
        const std::size_t at = front.first + j, entry = front.entry + j * nv;
        const auto KS = transpose_times(of.S_i, c.f.K[at]) + slice<nv>(c.f.E, entry);
        const auto Y = solve(of.D, KS);
        store(KS, c.KS, j * nv), store(Y, c.f.Y, entry);
        for (std::size_t k = 0; k < nv; ++k) {
          Rows& size = c.size[c.batch[at]];
          size = size + KS[k] * Y[k];
        }
        std::size_t pair = front.pair + j * (j + 1) / 2;
        for (std::size_t l = 0; l <= j; ++l) {
          ConstraintWorkspace::Block& G = c.f.G[c.block[pair++]];
          const auto Y_l = slice<nv>(c.f.Y, front.entry + l * nv);
          for (std::size_t k = 0; k < nv; ++k)
            for (std::size_t r = 0; r < 4; ++r) G[r] = G[r] + Rows(lane_of(KS[k], r)) * Y_l[k];
        }
        if (model.parent[i] == 0) continue;
        const Force<Rows> K = transpose_times(of.X, c.f.K[at] - times(of.U, Y));
        Force<Rows>& sum = c.f.K[c.above[at]];
        if (c.is_first[at])
          sum = K;
        else
          sum += K;
      }
    });
  }
}

template <class S>
[[gnu::flatten]] void constraint_forces(const Model<S>& model, ConstraintWorkspace& c,
                                        const std::vector<S>& b, std::size_t first,
                                        std::size_t end) {
  for (std::size_t i = end; i-- > first;)
    visit_factors<S>(model, c.f, i, [&](auto joint, const auto& of) {
      const auto u = carry_force(model, of, i, b, c.p, c.y);
      const ConstraintWorkspace::Front& front = c.fronts[i];
      for (std::size_t j = 0; j < front.open; ++j)
        for (std::size_t k = 0; k < joint.nv; ++k) {
          ConstraintWorkspace::Rows& s = c.s[c.batch[front.first + j]];
          s = s - c.f.Y[front.entry + j * joint.nv + k] * u[k];
        }
    });
}

template <class S>
[[gnu::flatten]] void constraint_accelerations(const Model<S>& model, ConstraintWorkspace& c,
                                               std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i)
    visit_factors<S>(model, c.f, i, [&](auto joint, const auto& of) {
      const std::size_t iv = model.iv[i];
      const Motion<S> dv = of.X * c.dv[static_cast<std::size_t>(model.parent[i])];
      auto y = slice<joint.nv>(c.y, iv) - solve(of.D, transpose_times(of.U, dv));
      const ConstraintWorkspace::Front& front = c.fronts[i];
      for (std::size_t k = 0; k < joint.nv && front.open > 0; ++k) {
        ConstraintWorkspace::Rows sum(0);
        for (std::size_t j = 0; j < front.open; ++j)
          sum = sum + c.f.Y[front.entry + j * joint.nv + k] * c.lambda[c.batch[front.first + j]];
        y[k] += (sum[0] + sum[1]) + (sum[2] + sum[3]);
      }
      c.dv[i] = dv + times(of.S_i, y);
      store(y, c.y, iv);
    });
}

}  // namespace twinarm::TWINARM_ISA
