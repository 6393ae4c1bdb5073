// Kinematics of the bodies with springs, after pass 1 of aba(): E (world to body axes), origin o in
// the world, and a_bias, the acceleration at qdd = 0, in body axes.
//
// Aligned: a revolute joint whose axes at zero are its parent's, so Xup rotates about z only.
// Planar: a body with aligned joints only down to the base: E rotates about z only (two numbers),
// which saves more than half of the products.
#pragma once

#include "coupling/batch/kernel/batch_state.h"
#include "solver/spatial/instruction_set.h"

namespace twinarm::TWINARM_ISA {

// Rotation about z with first row {c, s, 0}.
template <class S>
struct RotationAboutZ {
  S c, s;
  explicit RotationAboutZ(const Mat3<S>& E) : c(E.r0.x), s(E.r0.y) {}
  friend Vec3<S> operator*(const RotationAboutZ& E, const Vec3<S>& v) {
    return {E.c * v.x + E.s * v.y, E.c * v.y - E.s * v.x, v.z};
  }
};
template <class S>
Vec3<S> transpose_times(const RotationAboutZ<S>& E, const Vec3<S>& v) {
  return {E.c * v.x - E.s * v.y, E.s * v.x + E.c * v.y, v.z};
}

// E = X P; the other elements are constant.
template <class S>
void rotate_planar(const RotationAboutZ<S>& X, const RotationAboutZ<S>& P, Mat3<S>& E) {
  E.r0.x = E.r1.y = X.c * P.c - X.s * P.s;
  E.r0.y = X.s * P.c + X.c * P.s;
  E.r1.x = -E.r0.y;
}
template <class S>
void rotate_aligned(const RotationAboutZ<S>& X, const Mat3<S>& P, Mat3<S>& E) {
  E = {X.c * P.r0 + X.s * P.r1, X.c * P.r1 - X.s * P.r0, P.r2};
}
template <class S>
Motion<S> bias_aligned(const Transform<S>& X, const Motion<S>& a) {
  const RotationAboutZ<S> E(X.E);
  return {E * a.w, E * minus_cross(a.v, X.r, a.w)};
}
// Bias acceleration of a spring's point; a planar body has no angular part.
template <class S>
Vec3<S> bias_at(const Vec3<S>& p, const Mat3<S>&, const Motion<S>& a) {
  return plus_cross(a.v, a.w, p);
}
template <class S>
Vec3<S> bias_at(const Vec3<S>&, const RotationAboutZ<S>&, const Motion<S>& a) {
  return a.v;
}

template <class S>
TWINARM_KERNEL void update_rotations(BatchWork<S>& b) {
  for (std::size_t i = 1; i < b.E.size(); ++i) {
    const Frame frame = b.frames[i];
    if (frame == Frame::none) continue;
    const auto p = static_cast<std::size_t>(b.model.parent[i]);
    const Transform<S>& X = b.w.Xup[i];
    const Mat3<S>& P = b.E[p];
    if (p == 0)
      b.E[i] = X.E;
    else if (frame == Frame::planar)
      rotate_planar(RotationAboutZ<S>(X.E), RotationAboutZ<S>(P), b.E[i]);
    else if (frame == Frame::aligned)
      rotate_aligned(RotationAboutZ<S>(X.E), P, b.E[i]);
    else
      b.E[i] = X.E * P;
    if (!b.needs_origins) continue;
    b.o[i] = p == 0                   ? X.r
             : frame == Frame::planar ? b.o[p] + transpose_times(RotationAboutZ<S>(P), X.r)
                                      : b.o[p] + transpose_times(P, X.r);
  }
}

template <class S>
TWINARM_KERNEL void update_bias(BatchWork<S>& b) {
  for (std::size_t i = 1; i < b.E.size(); ++i) {
    if (b.frames[i] == Frame::none) continue;
    const Motion<S>& a = b.a_bias[static_cast<std::size_t>(b.model.parent[i])];
    const Transform<S>& X = b.w.Xup[i];
    if (b.frames[i] == Frame::planar)
      b.a_bias[i].v = RotationAboutZ<S>(X.E) * a.v + b.w.c[i].v;
    else
      b.a_bias[i] = (b.frames[i] == Frame::aligned ? bias_aligned(X, a) : X * a) + b.w.c[i];
  }
}

}  // namespace twinarm::TWINARM_ISA
