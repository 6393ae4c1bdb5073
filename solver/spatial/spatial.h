// Spatial vectors, transforms and inertias of RBDA chapter 2, in 3-D blocks, angular part first.
//
// Motion (w; v) and Force (n; f) are distinct types: elements of M^6 and F^6 do not add. Written
// out in scalars, which compilers optimize best (other libraries lose up to a factor 2.4 with
// expression templates), and templated on the scalar S: no branch on an S value. All operands of a
// formula are in the same frame; the frame is documented with the stored quantity (Workspace).
#pragma once

#include "solver/spatial/scalar.h"

namespace twinarm {

template <class S>
struct Vec3 {
  S x{}, y{}, z{};
  Vec3 operator-() const { return {-x, -y, -z}; }
  Vec3& operator+=(const Vec3& b) {
    x = x + b.x, y = y + b.y, z = z + b.z;
    return *this;
  }
  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(const S& s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
};
template <class S>
S dot(const Vec3<S>& a, const Vec3<S>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class S>
Vec3<S> cross(const Vec3<S>& a, const Vec3<S>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// a + r x b and a - r x b, ordered for fused multiply-add.
template <class S>
Vec3<S> plus_cross(const Vec3<S>& a, const Vec3<S>& r, const Vec3<S>& b) {
  return {a.x + r.y * b.z - r.z * b.y, a.y + r.z * b.x - r.x * b.z, a.z + r.x * b.y - r.y * b.x};
}
template <class S>
Vec3<S> minus_cross(const Vec3<S>& a, const Vec3<S>& r, const Vec3<S>& b) {
  return {a.x - r.y * b.z + r.z * b.y, a.y - r.z * b.x + r.x * b.z, a.z - r.x * b.y + r.y * b.x};
}

// General 3x3 matrix, row-major.
template <class S>
struct Mat3 {
  Vec3<S> r0, r1, r2;
  static Mat3 identity() { return {{S(1), S(0), S(0)}, {S(0), S(1), S(0)}, {S(0), S(0), S(1)}}; }
  Mat3& operator+=(const Mat3& b) {
    r0 += b.r0, r1 += b.r1, r2 += b.r2;
    return *this;
  }
  friend Mat3 operator+(const Mat3& a, const Mat3& b) {
    return {a.r0 + b.r0, a.r1 + b.r1, a.r2 + b.r2};
  }
  friend Mat3 operator-(const Mat3& a, const Mat3& b) {
    return {a.r0 - b.r0, a.r1 - b.r1, a.r2 - b.r2};
  }
  friend Vec3<S> operator*(const Mat3& a, const Vec3<S>& v) {
    return {dot(a.r0, v), dot(a.r1, v), dot(a.r2, v)};
  }
  friend Mat3 operator*(const Mat3& a, const Mat3& b) {
    return {transpose_times(b, a.r0), transpose_times(b, a.r1), transpose_times(b, a.r2)};
  }
};
template <class S>
Vec3<S> transpose_times(const Mat3<S>& a, const Vec3<S>& v) {  // a^T v
  return v.x * a.r0 + v.y * a.r1 + v.z * a.r2;
}
template <class S>
Mat3<S> transpose(const Mat3<S>& a) {
  return {{a.r0.x, a.r1.x, a.r2.x}, {a.r0.y, a.r1.y, a.r2.y}, {a.r0.z, a.r1.z, a.r2.z}};
}
template <class S>
S trace(const Mat3<S>& a) {
  return a.r0.x + a.r1.y + a.r2.z;
}
template <class S>
Mat3<S> outer(const Vec3<S>& a, const Vec3<S>& b) {
  return {a.x * b, a.y * b, a.z * b};
}

// Symmetric 3x3 matrix.
template <class S>
struct Sym3 {
  S xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
  static Sym3 scaled_identity(const S& s) { return {s, s, s, S(0), S(0), S(0)}; }
  Vec3<S> row0() const { return {xx, xy, xz}; }
  Vec3<S> row1() const { return {xy, yy, yz}; }
  Vec3<S> row2() const { return {xz, yz, zz}; }
  Sym3& operator+=(const Sym3& b) {
    xx = xx + b.xx, yy = yy + b.yy, zz = zz + b.zz;
    xy = xy + b.xy, xz = xz + b.xz, yz = yz + b.yz;
    return *this;
  }
  friend Sym3 operator+(const Sym3& a, const Sym3& b) {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
  }
  friend Sym3 operator-(const Sym3& a, const Sym3& b) {
    return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.xz - b.xz, a.yz - b.yz};
  }
  friend Vec3<S> operator*(const Sym3& a, const Vec3<S>& v) {
    return {dot(a.row0(), v), dot(a.row1(), v), dot(a.row2(), v)};
  }
};
template <class S>
Mat3<S> full(const Sym3<S>& a) {
  return {a.row0(), a.row1(), a.row2()};
}
template <class S>
Sym3<S> symmetric_part_of(const Mat3<S>& a) {  // upper triangle; a is symmetric up to rounding
  return {a.r0.x, a.r1.y, a.r2.z, a.r0.y, a.r0.z, a.r1.z};
}
template <class S>
Sym3<S> rotate_back(const Mat3<S>& E, const Sym3<S>& a) {  // E^T a E
  const Vec3<S>&e0 = E.r0, &e1 = E.r1, &e2 = E.r2;
  const Vec3<S> x = a.xx * e0 + a.xy * e1 + a.xz * e2, y = a.xy * e0 + a.yy * e1 + a.yz * e2,
                z = a.xz * e0 + a.yz * e1 + a.zz * e2;  // rows of a E
  return {e0.x * x.x + e1.x * y.x + e2.x * z.x, e0.y * x.y + e1.y * y.y + e2.y * z.y,
          e0.z * x.z + e1.z * y.z + e2.z * z.z, e0.x * x.y + e1.x * y.y + e2.x * z.y,
          e0.x * x.z + e1.x * y.z + e2.x * z.z, e0.y * x.z + e1.y * y.z + e2.y * z.z};
}

template <class S>
struct Motion {  // (w; v): angular velocity; linear velocity of the point at the frame's origin
  Vec3<S> w, v;
  Motion operator-() const { return {-w, -v}; }
  Motion& operator+=(const Motion& b) {
    w += b.w, v += b.v;
    return *this;
  }
  friend Motion operator+(const Motion& a, const Motion& b) { return {a.w + b.w, a.v + b.v}; }
  friend Motion operator-(const Motion& a, const Motion& b) { return {a.w - b.w, a.v - b.v}; }
  friend Motion operator*(const S& s, const Motion& a) { return {s * a.w, s * a.v}; }
};
template <class S>
struct Force {  // (n; f): moment about the frame's origin; force
  Vec3<S> n, f;
  Force operator-() const { return {-n, -f}; }
  Force& operator+=(const Force& b) {
    n += b.n, f += b.f;
    return *this;
  }
  friend Force operator+(const Force& a, const Force& b) { return {a.n + b.n, a.f + b.f}; }
  friend Force operator-(const Force& a, const Force& b) { return {a.n - b.n, a.f - b.f}; }
  friend Force operator*(const S& s, const Force& a) { return {s * a.n, s * a.f}; }
};
template <class S>
S dot(const Motion<S>& a, const Force<S>& b) {  // scalar product a . b (power)
  return dot(a.w, b.n) + dot(a.v, b.f);
}
template <class S>
Motion<S> crm(const Motion<S>& a, const Motion<S>& b) {  // a x b, RBDA (2.31)
  return {cross(a.w, b.w), plus_cross(cross(a.w, b.v), a.v, b.w)};
}
template <class S>
Force<S> crf(const Motion<S>& a, const Force<S>& b) {  // a x* b, RBDA (2.32)
  return {plus_cross(cross(a.w, b.n), a.v, b.f), cross(a.w, b.f)};
}

// Pluecker transform B_X_A = (E 0; -E rx E), RBDA (2.24): E maps coordinates in A to coordinates in
// B, r is the origin of B in A.
template <class S>
struct Transform {
  Mat3<S> E = Mat3<S>::identity();
  Vec3<S> r;
  friend Motion<S> operator*(const Transform& X, const Motion<S>& m) {
    return {X.E * m.w, X.E * minus_cross(m.v, X.r, m.w)};
  }
  friend Transform operator*(const Transform& X2, const Transform& X1) {
    return {X2.E * X1.E, X1.r + transpose_times(X1.E, X2.r)};
  }
};
template <class S>
Force<S> transpose_times(const Transform<S>& X, const Force<S>& f) {  // X^T f, from B to A
  const Vec3<S> f_A = transpose_times(X.E, f.f);
  return {plus_cross(transpose_times(X.E, f.n), X.r, f_A), f_A};
}

// Rigid-body inertia about the frame's origin, RBDA (2.63): mass, first moment h = m c, and
// rotational inertia I = I_com + m (c.c 1 - c c^T).
template <class S>
struct Inertia {
  S m{};
  Vec3<S> h;
  Sym3<S> I;
  Inertia& operator+=(const Inertia& b) {
    m = m + b.m, h += b.h, I += b.I;
    return *this;
  }
  friend Force<S> operator*(const Inertia& a, const Motion<S>& b) {
    return {plus_cross(a.I * b.w, a.h, b.v), minus_cross(a.m * b.v, a.h, b.w)};
  }
};

// sum += X^T I X, RBDA (2.66): adds a child's composite inertia to its parent's. First rotated to
// the parent's axes (h, I_r), then translated to the parent's origin:
//   I' = I_r + 2 (r.t) 1 - t r^T - r t^T,  t = h + m r / 2.
template <class S>
void add_congruence(const Transform<S>& X, const Inertia<S>& a, Inertia<S>& sum) {
  const Vec3<S> h = transpose_times(X.E, a.h), t = h + (S(0.5) * a.m) * X.r;
  const Vec3<S>& r = X.r;
  const S d = dot(r, t) + dot(r, t);
  const Sym3<S> I = rotate_back(X.E, a.I);
  sum.m = sum.m + a.m;
  sum.h += h + a.m * r;
  sum.I.xx = sum.I.xx + I.xx + d - (t.x * r.x + t.x * r.x);
  sum.I.yy = sum.I.yy + I.yy + d - (t.y * r.y + t.y * r.y);
  sum.I.zz = sum.I.zz + I.zz + d - (t.z * r.z + t.z * r.z);
  sum.I.xy = sum.I.xy + I.xy - t.x * r.y - t.y * r.x;
  sum.I.xz = sum.I.xz + I.xz - t.x * r.z - t.z * r.x;
  sum.I.yz = sum.I.yz + I.yz - t.y * r.z - t.z * r.y;
}

// Articulated-body inertia (I H; H^T M), RBDA section 7.1; I and M symmetric, 21 numbers.
template <class S>
struct ArticulatedInertia {
  Sym3<S> I;
  Mat3<S> H;
  Sym3<S> M;
  ArticulatedInertia() = default;
  ArticulatedInertia(const Sym3<S>& i, const Mat3<S>& h, const Sym3<S>& m) : I(i), H(h), M(m) {}
  explicit ArticulatedInertia(const Inertia<S>& a) { *this = a; }
  ArticulatedInertia& operator=(const Inertia<S>& a) {
    const S zero(0);
    I = a.I;
    H.r0.x = zero, H.r0.y = -a.h.z, H.r0.z = a.h.y;
    H.r1.x = a.h.z, H.r1.y = zero, H.r1.z = -a.h.x;
    H.r2.x = -a.h.y, H.r2.y = a.h.x, H.r2.z = zero;
    M.xx = M.yy = M.zz = a.m;
    M.xy = M.xz = M.yz = zero;
    return *this;
  }
  ArticulatedInertia& operator+=(const ArticulatedInertia& b) {
    I += b.I, H += b.H, M += b.M;
    return *this;
  }
  friend Force<S> operator*(const ArticulatedInertia& a, const Motion<S>& b) {
    return {a.I * b.w + a.H * b.v, a.M * b.v + transpose_times(a.H, b.w)};
  }
  friend ArticulatedInertia operator-(const ArticulatedInertia& a, const ArticulatedInertia& b) {
    return {a.I - b.I, a.H - b.H, a.M - b.M};
  }
};
// a b^T of two forces; requires a symmetric result (b parallel to a, or a symmetric sum).
template <class S>
ArticulatedInertia<S> outer(const Force<S>& a, const Force<S>& b) {
  return {symmetric_part_of(outer(a.n, b.n)), outer(a.n, b.f), symmetric_part_of(outer(a.f, b.f))};
}
// sum = before + (I' H'; H'^T M): the inertia (0 H; H^T M) translated by r, with
//   H' = H + [r]x M,   I' = [r]x H^T + ([r]x H'^T)^T.
template <class S>
void add_translated(const Vec3<S>& r, const Mat3<S>& H, const Sym3<S>& M,
                    const ArticulatedInertia<S>& before, ArticulatedInertia<S>& sum) {
  sum.M = before.M + M;
  const Mat3<S> Hs{H.r0 + r.y * M.row2() - r.z * M.row1(), H.r1 + r.z * M.row0() - r.x * M.row2(),
                   H.r2 + r.x * M.row1() - r.y * M.row0()};
  sum.H = before.H + Hs;
  const Vec3<S>&p0 = H.r0, &p1 = H.r1, &p2 = H.r2, &q0 = Hs.r0, &q1 = Hs.r1, &q2 = Hs.r2;
  sum.I.xx = before.I.xx + r.y * p0.z - r.z * p0.y + r.y * q0.z - r.z * q0.y;
  sum.I.yy = before.I.yy + r.z * p1.x - r.x * p1.z + r.z * q1.x - r.x * q1.z;
  sum.I.zz = before.I.zz + r.x * p2.y - r.y * p2.x + r.x * q2.y - r.y * q2.x;
  sum.I.xy = before.I.xy + r.y * p1.z - r.z * p1.y + r.z * q0.x - r.x * q0.z;
  sum.I.xz = before.I.xz + r.y * p2.z - r.z * p2.y + r.x * q0.y - r.y * q0.x;
  sum.I.yz = before.I.yz + r.z * p2.x - r.x * p2.z + r.x * q1.y - r.y * q1.x;
}
// parent = before + X^T IA X, RBDA (2.66), by rotation and translation. Block by block, to reduce
// register pressure; `before` may be `parent`.
template <class S>
void add_congruence(const Transform<S>& X, const ArticulatedInertia<S>& a,
                    const ArticulatedInertia<S>& before, ArticulatedInertia<S>& parent) {
  const Sym3<S> M = rotate_back(X.E, a.M);
  add_translated(X.r, transpose(X.E) * (a.H * X.E), M, before, parent);
  parent.I += rotate_back(X.E, a.I);
}

}  // namespace twinarm
