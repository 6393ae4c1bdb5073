// Types of motion subspaces S, RBDA section 3.5, and their products in the algorithms. S of each
// joint: joints.h.
//
// The type of S encodes its sparsity: if the columns of S are unit vectors of R^6, IA S are columns
// of IA, S^T U entries of U, and nothing is multiplied by 0 or 1. All quantities are in body axes.
#pragma once

#include <array>
#include <cstddef>

#include "solver/model/joint_algebra.h"
#include "solver/spatial/spatial.h"

namespace twinarm {

// S with unit vectors e_k as columns: k = 0..2 rotation about x, y, z, 3..5 translation along them.
template <int... k>
struct UnitAxes {};
using AxisZ = UnitAxes<2>;  // revolute joint
using NoAxes = UnitAxes<>;

// General S.
template <class S, std::size_t n>
struct Columns {
  std::array<Motion<S>, n> column;
};

// S = (1 0; 0 E): angular velocity in body axes, linear in parent axes; E from parent to body.
template <class S>
struct FreeJointSubspace {
  Mat3<S> E;
};

// Store the columns of S in the workspace and load them.
template <class S, int... k>
void store_subspace(UnitAxes<k...>, Motion<S>*) {}  // written once, by the workspace's constructor
template <class S, std::size_t n>
void store_subspace(const Columns<S, n>& c, Motion<S>* columns) {
  for (std::size_t k = 0; k < n; ++k) columns[k] = c.column[k];
}
template <class S>
void store_subspace(const FreeJointSubspace<S>& a, Motion<S>* columns) {
  const Mat3<S> Et = transpose(a.E);
  columns[3].v = Et.r0, columns[4].v = Et.r1, columns[5].v = Et.r2;
}
template <class S, int... k>
void load_subspace(const Motion<S>*, UnitAxes<k...>&) {}
template <class S, std::size_t n>
void load_subspace(const Motion<S>* columns, Columns<S, n>& c) {
  for (std::size_t k = 0; k < n; ++k) c.column[k] = columns[k];
}
template <class S>
void load_subspace(const Motion<S>* columns, FreeJointSubspace<S>& a) {
  a.E = transpose(Mat3<S>{columns[3].v, columns[4].v, columns[5].v});
}

// ---- sparse results ----

// vJ of a revolute joint: (0 0 rate; 0 0 0).
template <class S>
struct MotionAboutZ {
  S rate;
  explicit operator Motion<S>() const { return {{S(0), S(0), rate}, {}}; }
  friend Motion<S> operator+(const Motion<S>& a, const MotionAboutZ& b) {
    return {{a.w.x, a.w.y, a.w.z + b.rate}, a.v};
  }
};
// a x vJ of a revolute joint: no component about or along z.
template <class S>
struct MotionNormalToZ {
  S wx, wy, vx, vy;
  operator Motion<S>() const { return {{wx, wy, S(0)}, {vx, vy, S(0)}}; }
};
template <class S>
MotionNormalToZ<S> crm(const Motion<S>& a, const MotionAboutZ<S>& b) {
  const S minus = -b.rate;
  return {a.w.y * b.rate, a.w.x * minus, a.v.y * b.rate, a.v.x * minus};
}

// ---- S qd ----

template <int k, class S>
S& component(Motion<S>& m) {
  if constexpr (k == 0) return m.w.x;
  if constexpr (k == 1) return m.w.y;
  if constexpr (k == 2) return m.w.z;
  if constexpr (k == 3) return m.v.x;
  if constexpr (k == 4) return m.v.y;
  if constexpr (k == 5) return m.v.z;
}
template <int k, class S>
const S& component(const Force<S>& f) {
  if constexpr (k == 0) return f.n.x;
  if constexpr (k == 1) return f.n.y;
  if constexpr (k == 2) return f.n.z;
  if constexpr (k == 3) return f.f.x;
  if constexpr (k == 4) return f.f.y;
  if constexpr (k == 5) return f.f.z;
}
template <class S>
MotionAboutZ<S> times(AxisZ, const VecN<S, 1>& qd) {
  return {qd[0]};
}
template <class S, int... k>
Motion<S> times(UnitAxes<k...>, const VecN<S, sizeof...(k)>& qd) {
  Motion<S> m;
  [[maybe_unused]] std::size_t next = 0;
  ((component<k>(m) = qd[next++]), ...);
  return m;
}
template <class S, std::size_t n>
Motion<S> times(const Columns<S, n>& c, const VecN<S, n>& qd) {
  Motion<S> m = qd[0] * c.column[0];
  for (std::size_t k = 1; k < n; ++k) m += qd[k] * c.column[k];
  return m;
}
template <class S>
Motion<S> times(const FreeJointSubspace<S>& a, const VecN<S, 6>& qd) {
  return {{qd[0], qd[1], qd[2]}, a.E * Vec3<S>{qd[3], qd[4], qd[5]}};
}

// ---- U = IA S ----

template <class S, std::size_t n>
using ForceColumns = std::array<Force<S>, n>;  // 6 x n, column-major

template <int k, class S>
Force<S> column(const ArticulatedInertia<S>& A) {
  if constexpr (k == 0) return {A.I.row0(), A.H.r0};
  if constexpr (k == 1) return {A.I.row1(), A.H.r1};
  if constexpr (k == 2) return {A.I.row2(), A.H.r2};
  if constexpr (k == 3) return {{A.H.r0.x, A.H.r1.x, A.H.r2.x}, A.M.row0()};
  if constexpr (k == 4) return {{A.H.r0.y, A.H.r1.y, A.H.r2.y}, A.M.row1()};
  if constexpr (k == 5) return {{A.H.r0.z, A.H.r1.z, A.H.r2.z}, A.M.row2()};
}
template <class S, int... k>
ForceColumns<S, sizeof...(k)> operator*(const ArticulatedInertia<S>& IA, UnitAxes<k...>) {
  return {column<k>(IA)...};
}
template <class S, std::size_t n>
ForceColumns<S, n> operator*(const ArticulatedInertia<S>& IA, const Columns<S, n>& c) {
  ForceColumns<S, n> U;
  for (std::size_t k = 0; k < n; ++k) U[k] = IA * c.column[k];
  return U;
}
template <class S>
ForceColumns<S, 6> operator*(const ArticulatedInertia<S>& IA, const FreeJointSubspace<S>& a) {
  const auto linear = [&](const Vec3<S>& e) { return Force<S>{IA.H * e, IA.M * e}; };
  const Mat3<S> Et = transpose(a.E);
  return {column<0>(IA), column<1>(IA), column<2>(IA), linear(Et.r0), linear(Et.r1), linear(Et.r2)};
}

// ---- S^T f, and D = S^T U ----

template <class S, int... k>
VecN<S, sizeof...(k)> transpose_times(UnitAxes<k...>, const Force<S>& f) {
  return {component<k>(f)...};
}
template <class S, std::size_t n>
VecN<S, n> transpose_times(const Columns<S, n>& c, const Force<S>& f) {
  VecN<S, n> y;
  for (std::size_t k = 0; k < n; ++k) y[k] = dot(c.column[k], f);
  return y;
}
template <class S>
VecN<S, 6> transpose_times(const FreeJointSubspace<S>& a, const Force<S>& f) {
  const Vec3<S> along = transpose_times(a.E, f.f);
  return {f.n.x, f.n.y, f.n.z, along.x, along.y, along.z};
}
template <class Subspace, class S, std::size_t n>
MatN<S, n> transpose_times(const Subspace& subspace, const ForceColumns<S, n>& U) {
  MatN<S, n> D;
  for (std::size_t l = 0; l < n; ++l) {
    const VecN<S, n> column_l = transpose_times(subspace, U[l]);
    for (std::size_t k = 0; k < n; ++k) D[k][l] = column_l[k];
  }
  return D;
}

// ---- U y, U^T a ----

template <class S, std::size_t n>
Force<S> times(const ForceColumns<S, n>& U, const VecN<S, n>& y) {
  Force<S> f;
  if constexpr (n > 0) f = y[0] * U[0];
  for (std::size_t k = 1; k < n; ++k) f += y[k] * U[k];
  return f;
}
template <class S, std::size_t n>
VecN<S, n> transpose_times(const ForceColumns<S, n>& U, const Motion<S>& a) {
  VecN<S, n> y;
  for (std::size_t k = 0; k < n; ++k) y[k] = dot(a, U[k]);
  return y;
}

// ---- Ia = IA - U D^-1 U^T, apparent inertia across the joint ----

// Ia of a revolute joint without armature: row and column z (angular) are zero. 15 numbers.
template <class S>
struct RevoluteInertia {
  S xx, yy, xy;
  Vec3<S> h0, h1;
  Sym3<S> M;
  explicit operator ArticulatedInertia<S>() const {
    return {{xx, yy, S(0), xy, S(0), S(0)}, {h0, h1, {}}, M};
  }
  // Ia c for a c without components about and along z (MotionNormalToZ).
  friend Force<S> operator*(const RevoluteInertia& a, const Motion<S>& c) {
    return {{a.xx * c.w.x + a.xy * c.w.y + a.h0.x * c.v.x + a.h0.y * c.v.y,
             a.xy * c.w.x + a.yy * c.w.y + a.h1.x * c.v.x + a.h1.y * c.v.y, S(0)},
            {a.h0.x * c.w.x + a.h1.x * c.w.y + a.M.xx * c.v.x + a.M.xy * c.v.y,
             a.h0.y * c.w.x + a.h1.y * c.w.y + a.M.xy * c.v.x + a.M.yy * c.v.y,
             a.h0.z * c.w.x + a.h1.z * c.w.y + a.M.xz * c.v.x + a.M.yz * c.v.y}};
  }
};
template <class S>
void add_congruence(const Transform<S>& X, const RevoluteInertia<S>& a,
                    const ArticulatedInertia<S>& before, ArticulatedInertia<S>& parent) {
  const Vec3<S>&e0 = X.E.r0, &e1 = X.E.r1;
  const Sym3<S> M = rotate_back(X.E, a.M);
  const Vec3<S> h0 = transpose_times(X.E, a.h0), h1 = transpose_times(X.E, a.h1);  // rows of H E
  add_translated(X.r, {e0.x * h0 + e1.x * h1, e0.y * h0 + e1.y * h1, e0.z * h0 + e1.z * h1}, M,
                 before, parent);
  const Vec3<S> i0 = a.xx * e0 + a.xy * e1, i1 = a.xy * e0 + a.yy * e1;  // rows of I E
  Sym3<S>& I = parent.I;
  I.xx = I.xx + e0.x * i0.x + e1.x * i1.x, I.xy = I.xy + e0.x * i0.y + e1.x * i1.y;
  I.yy = I.yy + e0.y * i0.y + e1.y * i1.y, I.xz = I.xz + e0.x * i0.z + e1.x * i1.z;
  I.zz = I.zz + e0.z * i0.z + e1.z * i1.z, I.yz = I.yz + e0.y * i0.z + e1.y * i1.z;
}

// IA - sum_k w_k w_k^T / d_k, with D = L d L^T and W = U L^-T: n rank-1 updates. An explicit D^-1
// would lose a factor cond(D) of accuracy (heavy body on a light one).
template <class S, std::size_t n>
ArticulatedInertia<S> subtract_rank_n(ArticulatedInertia<S> IA, ForceColumns<S, n> U,
                                      const Spd<S, n>& D) {
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t j = 0; j < k; ++j) U[k] = U[k] - D.L[row_of_L(k) + j] * U[j];
    IA = IA - outer(D.inverse_d[k] * U[k], U[k]);
  }
  return IA;
}

// Sparsity of Ia: dense, or that of a revolute joint without armature.
struct FullInertia {};
struct RevoluteSparsity {};

template <class S, std::size_t n>
ArticulatedInertia<S> apparent_inertia(FullInertia, const ArticulatedInertia<S>& IA,
                                       const ForceColumns<S, n>& U, const Spd<S, n>& D) {
  return subtract_rank_n(IA, U, D);
}
template <class S>
RevoluteInertia<S> apparent_inertia(RevoluteSparsity, const ArticulatedInertia<S>& IA,
                                    const ForceColumns<S, 1>& U, const Spd<S, 1>& D) {
  const Vec3<S>&n = U[0].n, &l = U[0].f;
  const S nx = D.inverse_d[0] * n.x, ny = D.inverse_d[0] * n.y;
  const Vec3<S> m = D.inverse_d[0] * l;
  return {IA.I.xx - n.x * nx,
          IA.I.yy - n.y * ny,
          IA.I.xy - n.x * ny,
          IA.H.r0 - nx * l,
          IA.H.r1 - ny * l,
          {IA.M.xx - l.x * m.x, IA.M.yy - l.y * m.y, IA.M.zz - l.z * m.z, IA.M.xy - l.x * m.y,
           IA.M.xz - l.x * m.z, IA.M.yz - l.y * m.z}};
}

}  // namespace twinarm
