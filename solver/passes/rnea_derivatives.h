// Derivatives of inverse dynamics by q and qd, in O(n d): d tau / d q and d tau / d qd at given
// qdd.
//
// Carpentier and Mansard (2018); in the form of Singh, Russell and Wensing (2022), in the axes of
// Workspace::Xr.
// p: parent of joint j, S_j' = v_p x S_j the rate of S_j if joint j stood still.
//
//   dS_j  = v_p x S_j,   ddS_j = a_p x S_j + v_p x dS_j,   sS_j = dS_j + v_j x S_j
//   for j an ancestor of i or i itself, with the sums I, B and f over the subtree of i:
//   d tau_i / d q_j  = S_i^T (2 B dS_j + I ddS_j),     d tau_i / d qd_j = S_i^T (2 B S_j + I sS_j)
//   d tau_j / d q_i  = S_j^T (2 B dS_i + I ddS_i + S_i x* f),   for j not i
//   d tau_j / d qd_i = S_j^T (2 B S_i + I sS_i)
//
// 2 B = (v x*) I - I (v x) + (I v) xbar* of the paper acts on the angular part e of a motion alone:
// with R = sum of m v r^T over the points of the body and its linear momentum P,
//   2 B (e; .) = (2 (tr(R) e - R e); 2 e x P).
// Inertias A that springs add (Forces::added_inertia) are in IA only, not in v x* I v: they add A
// to I and -A (v x) to 2 B. docs/understand/derivatives.md derives both.
//
// q: along the velocities of the joints (q exp(s e_k)). Joints whose S depends on q are simpler
// joints in series (series_of). External wrenches are fixed in body axes. Reads Xup and S of aba()
// or rnea() at the same state; writes dtau = (d tau/dq, d tau/dqd), nv x 2 nv, row-major.
// Interface: solver/dynamics/derivatives.h.
#pragma once

#include <span>

#include "solver/model/matrix_workspace.h"
#include "solver/spatial/instruction_set.h"

namespace twinarm::TWINARM_ISA {

// The sums of one body alone.
template <class S>
SubtreeSums<S> sums_of_body(const Transform<S>& X, const Inertia<S>& I_B, const Force<S>& f_ext_B,
                            const Motion<S>& v, const Motion<S>& a) {
  SubtreeSums<S> body;
  add_congruence(X, I_B, body.I);
  const Inertia<S>& I = body.I;
  const Force<S> momentum = I * v;
  body.f = I * a + crf(v, momentum) - transpose_times(X, f_ext_B);
  body.P = momentum.f;
  // R = v h^T + w x (sum of m r r^T)
  const S half = S(0.5) * (I.I.xx + I.I.yy + I.I.zz);
  const Vec3<S> wx = cross(v.w, {half - I.I.xx, -I.I.xy, -I.I.xz}),
                wy = cross(v.w, {-I.I.xy, half - I.I.yy, -I.I.yz}),
                wz = cross(v.w, {-I.I.xz, -I.I.yz, half - I.I.zz});
  body.R = outer(v.v, I.h);
  body.R += Mat3<S>{{wx.x, wy.x, wz.x}, {wx.y, wy.y, wz.y}, {wx.z, wy.z, wz.z}};
  return body;
}

template <class S>
void add_added_inertia(const Transform<S>& X, const ArticulatedInertia<S>& A_B, const Motion<S>& v,
                       const Motion<S>& a, SubtreeSums<S>& body) {
  add_congruence(X, A_B, ArticulatedInertia<S>{}, body.A);
  body.f += body.A * a;
  for (std::size_t k = 0; k < 6; ++k) {
    Six<S> e{};
    e[k] = S(1);
    body.A_crm[k] = body.A * crm(v, Motion<S>{{e[0], e[1], e[2]}, {e[3], e[4], e[5]}});
  }
}

// From the base to the tips: motions, and the sums of each body alone.
template <class S>
void motions(const Model<S>& model, const State<S>& x, const Forces<S>& forces,
             const std::vector<S>& qdd, Workspace<S>& w, MatrixWorkspace<S>& m) {
  m.v[0] = {};
  m.a[0] = {{}, -model.gravity};
  for (std::size_t i = 1; i < model.parent.size(); ++i)
    visit_joint(model, i, [&](auto joint) {
      const auto p = static_cast<std::size_t>(model.parent[i]);
      const std::size_t iv = model.iv[i];
      const Transform<S> X = place(model, i, w);
      Motion<S> v = m.v[p], a = m.a[p];
      const auto move = [&](const Motion<S>& vJ, const Motion<S>& aJ) {
        a += aJ + crm(v, vJ);
        v += vJ;
      };
      if constexpr (requires { joint.np; }) {
        const S* given = x.rates(joint, model, i);
        move(to_common_axes(X, joint.vJ(given)), to_common_axes(X, joint.cJ(nullptr, given)));
      }
      for (const DofRange& group : series_of(joint)) {
        Motion<S> vJ, aJ;
        for (std::size_t k = iv + group.first; k < iv + group.end; ++k) {
          const Motion<S> axis = to_common_axes(X, w.S_[k]), rate = crm(v, axis);
          m.axes.set(k, six(axis));
          m.dS.set(k, six(rate));
          m.ddS.set(k, six(crm(a, axis) + crm(v, rate)));
          vJ += x.qd[k] * axis;
          aJ += qdd[k] * axis;
        }
        move(vJ, aJ);
        for (std::size_t k = iv + group.first; k < iv + group.end; ++k)
          m.sS.set(k, six(m.dS.motion(k) + crm(v, m.axes.motion(k))));
      }
      m.v[i] = v, m.a[i] = a;
      m.sums[i] = sums_of_body(X, model.I[i], forces.f_ext[i], v, a);
      if (forces.has_added_inertia) add_added_inertia(X, forces.added_inertia[i], v, a, m.sums[i]);
    });
}

// 2 B e and (2 B)^T axis, of the sums of a subtree.
template <class S>
Force<S> twice_B(const SubtreeSums<S>& sums, bool has_added_inertia, const Motion<S>& e) {
  const Vec3<S> traced = trace(sums.R) * e.w - sums.R * e.w;
  Force<S> f{traced + traced, cross(e.w, sums.P + sums.P)};
  if (!has_added_inertia) return f;
  const Six<S> by = six(e);
  for (std::size_t k = 0; k < 6; ++k) f += -by[k] * sums.A_crm[k];
  return f;
}
template <class S>
Force<S> twice_B_transposed(const SubtreeSums<S>& sums, bool has_added_inertia,
                            const Motion<S>& axis) {
  const Vec3<S> half =
      trace(sums.R) * axis.w - transpose_times(sums.R, axis.w) + cross(sums.P, axis.v);
  Force<S> f{half + half, {}};
  if (!has_added_inertia) return f;
  const auto by = [&](std::size_t k) { return dot(axis, sums.A_crm[k]); };
  return f - Force<S>{{by(0), by(1), by(2)}, {by(3), by(4), by(5)}};
}

template <class S>
[[gnu::flatten]] void rnea_derivatives(const Model<S>& model, const State<S>& x,
                                       const Forces<S>& forces, const std::vector<S>& qdd,
                                       Workspace<S>& w, MatrixWorkspace<S>& m, std::span<S> dtau) {
  motions(model, x, forces, qdd, w, m);
  std::ranges::fill(dtau, S(0));
  const std::size_t nv = model.nv;
  const bool added = forces.has_added_inertia;
  const auto axes = m.axes.pointers(), dS = m.dS.pointers(), ddS = m.ddS.pointers(),
             sS = m.sS.pointers();

  for (std::size_t i = model.parent.size(); i-- > 1;) {
    const SubtreeSums<S>& sums = m.sums[i];
    const auto I = [&](const Motion<S>& e) { return added ? sums.I * e + sums.A * e : sums.I * e; };
    const auto of_group = [&](const DofRange& group, auto&& visit_before) {
      for (std::size_t k = model.iv[i] + group.first; k < model.iv[i] + group.end; ++k) {
        const Motion<S> axis = m.axes.motion(k);
        const Six<S> I_axis = six(I(axis)), B_axis = six(twice_B_transposed(sums, added, axis));
        const auto row = [&](const DofRange& of) {
          S *const by_q = &dtau[2 * nv * k], *const by_qd = by_q + nv;
          TWINARM_INDEPENDENT
          for (std::size_t j = of.first; j < of.end; ++j) {
            by_q[j] = dot(I_axis, ddS, j) + dot(B_axis, dS, j);
            by_qd[j] = dot(I_axis, sS, j) + dot(B_axis, axes, j);
          }
        };
        const Six<S> F_q = six(twice_B(sums, added, m.dS.motion(k)) + I(m.ddS.motion(k)) +
                               crf(axis, sums.f)),
                     F_qd = six(twice_B(sums, added, axis) + I(m.sS.motion(k)));
        const auto column = [&](const DofRange& of) {
          S *const by_q = &dtau[k], *const by_qd = by_q + nv;
          TWINARM_INDEPENDENT
          for (std::size_t j = of.first; j < of.end; ++j) {
            by_q[2 * nv * j] = dot(F_q, axes, j);
            by_qd[2 * nv * j] = dot(F_qd, axes, j);
          }
        };
        row({model.iv[i] + group.first, model.iv[i] + group.end});
        visit_before([&](const DofRange& of) { row(of), column(of); });
      }
    };
    visit_joint(model, i, [&](auto joint) {
      const auto groups = series_of(joint);
      for (std::size_t g = 0; g < groups.size(); ++g)
        of_group(groups[g], [&](auto&& visit) {
          for (std::size_t before = 0; before < g; ++before)
            visit(DofRange{model.iv[i] + groups[before].first, model.iv[i] + groups[before].end});
          visit_ancestors(model, i, visit);
        });
    });
    if (model.parent[i] > 0) m.sums[static_cast<std::size_t>(model.parent[i])].add(sums, added);
  }
}

}  // namespace twinarm::TWINARM_ISA
