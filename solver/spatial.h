// Spatial vectors, transforms and inertias of RBDA chapter 2, in 3-D blocks, angular part first.
//
// Motion (w; v) and Force (n; f) are different types: a force does not add to a velocity. Written
// out in scalars, because both compilers see through it (expression templates cost the peers up to
// a factor 2.4), and templated on the scalar S: no `if` on an S value. All quantities of one
// formula are in the same frame; the frame is named where the quantity is stored (Workspace).
#pragma once

namespace twinarm {

// condition ? a : b, lane by lane where S has lanes. Both sides are evaluated.
template <class S>
S select(bool condition, const S& a, const S& b) {
  return condition ? a : b;
}

template <class S>
struct Vec3 {
  S x{}, y{}, z{};
  Vec3 operator-() const { return {-x, -y, -z}; }
  Vec3& operator+=(const Vec3& b) { return *this = *this + b; }
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

// General 3x3 matrix, by rows.
template <class S>
struct Mat3 {
  Vec3<S> r0, r1, r2;
  static Mat3 identity() { return {{S(1), S(0), S(0)}, {S(0), S(1), S(0)}, {S(0), S(0), S(1)}}; }
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
Mat3<S> skew(const Vec3<S>& r) {  // skew(r) v = r x v
  return {{S(0), -r.z, r.y}, {r.z, S(0), -r.x}, {-r.y, r.x, S(0)}};
}
template <class S>
Mat3<S> outer(const Vec3<S>& a, const Vec3<S>& b) {
  return {a.x * b, a.y * b, a.z * b};
}

// Symmetric 3x3 matrix: six numbers.
template <class S>
struct Sym3 {
  S xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
  static Sym3 scaled_identity(const S& s) { return {s, s, s, S(0), S(0), S(0)}; }
  Vec3<S> row0() const { return {xx, xy, xz}; }
  Vec3<S> row1() const { return {xy, yy, yz}; }
  Vec3<S> row2() const { return {xz, yz, zz}; }
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
Sym3<S> symmetric_part_of(const Mat3<S>& a) {  // for a matrix that is symmetric but for rounding
  return {a.r0.x, a.r1.y, a.r2.z, a.r0.y, a.r0.z, a.r1.z};
}
template <class S>
Sym3<S> rotate_back(const Mat3<S>& E, const Sym3<S>& a) {  // E^T a E, six outputs
  const Mat3<S> aE = full(a) * E;
  const Vec3<S> c0{E.r0.x, E.r1.x, E.r2.x}, c1{E.r0.y, E.r1.y, E.r2.y}, c2{E.r0.z, E.r1.z, E.r2.z};
  const Vec3<S> b0{aE.r0.x, aE.r1.x, aE.r2.x}, b1{aE.r0.y, aE.r1.y, aE.r2.y},
      b2{aE.r0.z, aE.r1.z, aE.r2.z};
  return {dot(c0, b0), dot(c1, b1), dot(c2, b2), dot(c0, b1), dot(c0, b2), dot(c1, b2)};
}

template <class S>
struct Motion {  // (w; v): angular, then linear velocity of the frame's origin
  Vec3<S> w, v;
  Motion operator-() const { return {-w, -v}; }
  Motion& operator+=(const Motion& b) { return *this = *this + b; }
  friend Motion operator+(const Motion& a, const Motion& b) { return {a.w + b.w, a.v + b.v}; }
  friend Motion operator-(const Motion& a, const Motion& b) { return {a.w - b.w, a.v - b.v}; }
  friend Motion operator*(const S& s, const Motion& a) { return {s * a.w, s * a.v}; }
};
template <class S>
struct Force {  // (n; f): couple about the frame's origin, then force
  Vec3<S> n, f;
  Force operator-() const { return {-n, -f}; }
  Force& operator+=(const Force& b) { return *this = *this + b; }
  friend Force operator+(const Force& a, const Force& b) { return {a.n + b.n, a.f + b.f}; }
  friend Force operator-(const Force& a, const Force& b) { return {a.n - b.n, a.f - b.f}; }
  friend Force operator*(const S& s, const Force& a) { return {s * a.n, s * a.f}; }
};
template <class S>
S dot(const Motion<S>& a, const Force<S>& b) {  // power of the force b at the velocity a
  return dot(a.w, b.n) + dot(a.v, b.f);
}
template <class S>
Motion<S> crm(const Motion<S>& a, const Motion<S>& b) {  // a x b, RBDA (2.31)
  return {cross(a.w, b.w), cross(a.w, b.v) + cross(a.v, b.w)};
}
template <class S>
Force<S> crf(const Motion<S>& a, const Force<S>& b) {  // a x* b, RBDA (2.32)
  return {cross(a.w, b.n) + cross(a.v, b.f), cross(a.w, b.f)};
}

// Pluecker transform B_X_A, RBDA (2.24): E turns coordinates in A into coordinates in B, r is the
// origin of B in A.
template <class S>
struct Transform {
  Mat3<S> E = Mat3<S>::identity();
  Vec3<S> r;
  friend Motion<S> operator*(const Transform& X, const Motion<S>& m) {
    return {X.E * m.w, X.E * (m.v - cross(X.r, m.w))};
  }
  friend Transform operator*(const Transform& X2, const Transform& X1) {
    return {X2.E * X1.E, X1.r + transpose_times(X1.E, X2.r)};
  }
};
template <class S>
Force<S> transpose_times(const Transform<S>& X, const Force<S>& f) {  // X^T f, from B to A
  const Vec3<S> f_A = transpose_times(X.E, f.f);
  return {transpose_times(X.E, f.n) + cross(X.r, f_A), f_A};
}

// Rigid-body inertia about the frame's origin, RBDA (2.63): mass, first moment h = m c, and
// rotational inertia I = I_com + m (c.c 1 - c c^T).
template <class S>
struct Inertia {
  S m{};
  Vec3<S> h;
  Sym3<S> I;
  friend Force<S> operator*(const Inertia& a, const Motion<S>& b) {
    return {a.I * b.w + cross(a.h, b.v), a.m * b.v - cross(a.h, b.w)};
  }
};

// Articulated-body inertia [I H; H^T M], RBDA (7.22): 6 + 9 + 6 numbers.
template <class S>
struct ArticulatedInertia {
  Sym3<S> I;
  Mat3<S> H;
  Sym3<S> M;
  ArticulatedInertia() = default;
  ArticulatedInertia(const Sym3<S>& i, const Mat3<S>& h, const Sym3<S>& m) : I(i), H(h), M(m) {}
  explicit ArticulatedInertia(const Inertia<S>& a)
      : I(a.I), H(skew(a.h)), M(Sym3<S>::scaled_identity(a.m)) {}
  ArticulatedInertia& operator+=(const ArticulatedInertia& b) { return *this = *this + b; }
  friend Force<S> operator*(const ArticulatedInertia& a, const Motion<S>& b) {
    return {a.I * b.w + a.H * b.v, a.M * b.v + transpose_times(a.H, b.w)};
  }
  friend ArticulatedInertia operator+(const ArticulatedInertia& a, const ArticulatedInertia& b) {
    return {a.I + b.I, a.H + b.H, a.M + b.M};
  }
  friend ArticulatedInertia operator-(const ArticulatedInertia& a, const ArticulatedInertia& b) {
    return {a.I - b.I, a.H - b.H, a.M - b.M};
  }
};
// a b^T of two forces, where the result is known to be symmetric (b a multiple of a, or a sum of
// such products that is symmetric as a whole).
template <class S>
ArticulatedInertia<S> outer(const Force<S>& a, const Force<S>& b) {
  return {symmetric_part_of(outer(a.n, b.n)), outer(a.n, b.f), symmetric_part_of(outer(a.f, b.f))};
}
// X^T IA X: the inertia of a child as its parent feels it, RBDA (2.66), by rotation and shift.
template <class S>
ArticulatedInertia<S> congruence(const Transform<S>& X, const ArticulatedInertia<S>& a) {
  const Sym3<S> I = rotate_back(X.E, a.I);
  const Mat3<S> H = transpose(X.E) * a.H * X.E;
  const Sym3<S> M = rotate_back(X.E, a.M);
  const Mat3<S> rx = skew(X.r);
  const Mat3<S> H_shifted = H + rx * full(M);
  const Mat3<S> dI = rx * transpose(H_shifted) - H * rx;
  return {I + symmetric_part_of(dI), H_shifted, M};
}

}  // namespace twinarm
