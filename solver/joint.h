// Joint models, RBDA table 4.1: transform XJ(q), motion subspace S, integration on the group.
//
// The model builder turns every body frame so that the axis of a one-dof joint is its z axis. S is
// then a unit basis vector of R^6 that the compiler knows: IA S is a column of IA and S^T U an
// entry of U (the operators at the end of this file). All quantities are in body coordinates.
// A joint of a new type is one struct here and its name in the list at the bottom.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "solver/spatial.h"

namespace twinarm {

// Motion subspaces. UnitAxis<k>: one column, the k-th basis vector (0..2 turn about x, y, z; 3..5
// shift along x, y, z). AllAxes: the 6x6 identity. NoAxes: no column.
template <int k>
struct UnitAxis {};
struct AllAxes {};
struct NoAxes {};

template <class S, std::size_t n>
using VecN = std::array<S, n>;
template <class S, std::size_t n>
using MatN = std::array<std::array<S, n>, n>;
template <class S, std::size_t n>
using ForceColumns = std::array<Force<S>, n>;  // U = IA S, 6 x n by columns

template <class S>
struct FixedJoint {
  static constexpr std::size_t nq = 0, nv = 0;
  static constexpr NoAxes subspace{};
  static Transform<S> XJ(const S*) { return {}; }
  static void integrate(const S*, const S*, S*) {}
  static VecN<S, 0> dexpinv(const VecN<S, 0>&, const VecN<S, 0>&) { return {}; }
};

// Turns about z.
template <class S>
struct RevoluteJoint {
  static constexpr std::size_t nq = 1, nv = 1;
  static constexpr UnitAxis<2> subspace{};
  static Transform<S> XJ(const S* q) {
    using std::cos, std::sin;
    const S c = cos(q[0]), s = sin(q[0]);
    return {{{c, s, S(0)}, {-s, c, S(0)}, {S(0), S(0), S(1)}}, {}};
  }
  static void integrate(const S* q, const S* shift, S* out) { out[0] = q[0] + shift[0]; }
  static VecN<S, 1> dexpinv(const VecN<S, 1>&, const VecN<S, 1>& qd) { return qd; }
};

// Shifts along z.
template <class S>
struct PrismaticJoint {
  static constexpr std::size_t nq = 1, nv = 1;
  static constexpr UnitAxis<5> subspace{};
  static Transform<S> XJ(const S* q) { return {Mat3<S>::identity(), {S(0), S(0), q[0]}}; }
  static void integrate(const S* q, const S* shift, S* out) { out[0] = q[0] + shift[0]; }
  static VecN<S, 1> dexpinv(const VecN<S, 1>&, const VecN<S, 1>& qd) { return qd; }
};

// Six degrees of freedom. q = (x, y, z; w, x, y, z): origin of the body in the parent, and the unit
// quaternion that turns body coordinates into parent coordinates. qd = (w; v) in body coordinates,
// so S is the identity and cJ = 0.
template <class S>
struct FreeJoint {
  static constexpr std::size_t nq = 7, nv = 6;
  static constexpr AllAxes subspace{};
  static Transform<S> XJ(const S* q);
  // q exp(shift) on SE(3), shift = (turn; shift) in body coordinates.
  static void integrate(const S* q, const S* shift, S* out);
  // d/dt of theta where q(t) = q(0) exp(theta(t)), up to third order in theta: what a Runge-Kutta
  // method of order 4 needs on a group (Munthe-Kaas 1998).
  static VecN<S, 6> dexpinv(const VecN<S, 6>& theta, const VecN<S, 6>& qd);
};

// What is listed here exists everywhere: builder, passes, contract tests.
enum class JointType { fixed, revolute, prismatic, free };
inline constexpr std::array<JointType, 4> all_joint_types{JointType::fixed, JointType::revolute,
                                                          JointType::prismatic, JointType::free};
inline const char* name_of(JointType type) {
  constexpr std::array<const char*, 4> names{"fixed", "revolute", "prismatic", "free"};
  return names[static_cast<std::size_t>(type)];
}

// Calls f with the joint struct of this type: f(RevoluteJoint<S>{}), and so on.
template <class S, class F>
void visit_joint(JointType type, F&& f) {
  switch (type) {
    case JointType::fixed:
      return f(FixedJoint<S>{});
    case JointType::revolute:
      return f(RevoluteJoint<S>{});
    case JointType::prismatic:
      return f(PrismaticJoint<S>{});
    case JointType::free:
      return f(FreeJoint<S>{});
  }
}

// ---- products of a motion subspace with what the passes multiply it by -------------------------

template <class S>
Force<S> column(const ArticulatedInertia<S>& IA, int k) {
  const Mat3<S> Ht = transpose(IA.H);
  switch (k) {
    case 0:
      return {IA.I.row0(), IA.H.r0};
    case 1:
      return {IA.I.row1(), IA.H.r1};
    case 2:
      return {IA.I.row2(), IA.H.r2};
    case 3:
      return {Ht.r0, IA.M.row0()};
    case 4:
      return {Ht.r1, IA.M.row1()};
    default:
      return {Ht.r2, IA.M.row2()};
  }
}
template <class S>
S component(const Force<S>& f, int k) {
  switch (k) {
    case 0:
      return f.n.x;
    case 1:
      return f.n.y;
    case 2:
      return f.n.z;
    case 3:
      return f.f.x;
    case 4:
      return f.f.y;
    default:
      return f.f.z;
  }
}
template <class S>
Motion<S> basis_motion(int k, const S& s) {
  const auto e = [&](int i) { return i == k ? s : S(0); };
  return {{e(0), e(1), e(2)}, {e(3), e(4), e(5)}};
}

// S qd
template <class S>
Motion<S> times(NoAxes, const VecN<S, 0>&) {
  return {};
}
template <class S, int k>
Motion<S> times(UnitAxis<k>, const VecN<S, 1>& qd) {
  return basis_motion(k, qd[0]);
}
template <class S>
Motion<S> times(AllAxes, const VecN<S, 6>& qd) {
  return {{qd[0], qd[1], qd[2]}, {qd[3], qd[4], qd[5]}};
}
// IA S
template <class S>
ForceColumns<S, 0> operator*(const ArticulatedInertia<S>&, NoAxes) {
  return {};
}
template <class S, int k>
ForceColumns<S, 1> operator*(const ArticulatedInertia<S>& IA, UnitAxis<k>) {
  return {column(IA, k)};
}
template <class S>
ForceColumns<S, 6> operator*(const ArticulatedInertia<S>& IA, AllAxes) {
  return {column(IA, 0), column(IA, 1), column(IA, 2), column(IA, 3), column(IA, 4), column(IA, 5)};
}
// S^T f
template <class S>
VecN<S, 0> transpose_times(NoAxes, const Force<S>&) {
  return {};
}
template <class S, int k>
VecN<S, 1> transpose_times(UnitAxis<k>, const Force<S>& f) {
  return {component(f, k)};
}
template <class S>
VecN<S, 6> transpose_times(AllAxes, const Force<S>& f) {
  return {f.n.x, f.n.y, f.n.z, f.f.x, f.f.y, f.f.z};
}
// S^T U, U = IA S: symmetric n x n
template <class Subspace, class S, std::size_t n>
MatN<S, n> transpose_times(Subspace subspace, const std::array<Force<S>, n>& U) {
  MatN<S, n> D{};
  for (std::size_t l = 0; l < n; ++l) {
    const auto column_l = transpose_times(subspace, U[l]);
    for (std::size_t k = 0; k < n; ++k) D[k][l] = column_l[k];
  }
  return D;
}

// ---- small dense algebra of a joint (n = nv) ----------------------------------------------------

// Inverse of a symmetric positive definite matrix, by L D L^T without pivoting. D is the inertia
// that a joint feels, positive wherever the bodies outward of it have inertia (RBDA section 7.1).
template <class S, std::size_t n>
MatN<S, n> inverse_spd(const MatN<S, n>& A) {
  MatN<S, n> L{}, inverse{};
  VecN<S, n> d{};
  for (std::size_t j = 0; j < n; ++j) {
    d[j] = A[j][j];
    for (std::size_t k = 0; k < j; ++k) d[j] = d[j] - L[j][k] * L[j][k] * d[k];
    for (std::size_t i = j + 1; i < n; ++i) {
      L[i][j] = A[i][j];
      for (std::size_t k = 0; k < j; ++k) L[i][j] = L[i][j] - L[i][k] * L[j][k] * d[k];
      L[i][j] = L[i][j] / d[j];
    }
  }
  for (std::size_t c = 0; c < n; ++c) {
    VecN<S, n> y{};
    for (std::size_t i = 0; i < n; ++i) {
      y[i] = S(i == c ? 1 : 0);
      for (std::size_t k = 0; k < i; ++k) y[i] = y[i] - L[i][k] * y[k];
    }
    for (std::size_t i = n; i-- > 0;) {
      y[i] = y[i] / d[i];
      for (std::size_t k = i + 1; k < n; ++k) y[i] = y[i] - L[k][i] * y[k];
      inverse[i][c] = y[i];
    }
  }
  return inverse;
}
template <class S, std::size_t n>
VecN<S, n> operator*(const MatN<S, n>& A, const VecN<S, n>& b) {
  VecN<S, n> y{};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) y[i] = y[i] + A[i][k] * b[k];
  return y;
}
// U y
template <class S, std::size_t n>
Force<S> times(const std::array<Force<S>, n>& U, const VecN<S, n>& y) {
  Force<S> f;
  for (std::size_t k = 0; k < n; ++k) f += y[k] * U[k];
  return f;
}
// U^T a
template <class S, std::size_t n>
VecN<S, n> transpose_times(const std::array<Force<S>, n>& U, const Motion<S>& a) {
  VecN<S, n> y{};
  for (std::size_t k = 0; k < n; ++k) y[k] = dot(a, U[k]);
  return y;
}
// U A U^T, A symmetric
template <class S, std::size_t n>
ArticulatedInertia<S> congruence(const std::array<Force<S>, n>& U, const MatN<S, n>& A) {
  ArticulatedInertia<S> sum;
  for (std::size_t l = 0; l < n; ++l) {
    Force<S> UA_l;
    for (std::size_t k = 0; k < n; ++k) UA_l += A[k][l] * U[k];
    sum += outer(UA_l, U[l]);
  }
  return sum;
}

}  // namespace twinarm

#include "solver/free_joint.inl"
