// Rotations about z, and unit quaternions (w, x, y, z) with the exponential map of SO(3).
#pragma once

#include "solver/spatial/spatial.h"

namespace twinarm {

// Coordinate transform of a rotation about z: E = (c s 0; -s c 0; 0 0 1), r = 0.
template <class S>
struct RotationZ {
  S c, s;
  explicit RotationZ(const SinCos<S>& both) : c(both.cos), s(both.sin) {}
  explicit RotationZ(const S& angle) : RotationZ(sin_cos(angle)) {}
  Mat3<S> E() const { return {{c, s, S(0)}, {-s, c, S(0)}, {S(0), S(0), S(1)}}; }
  friend Transform<S> operator*(const RotationZ& a, const Transform<S>& X) {
    return {{a.c * X.E.r0 + a.s * X.E.r1, a.c * X.E.r1 - a.s * X.E.r0, X.E.r2}, X.r};
  }
};

// E = R^T of a unit quaternion; R maps child coordinates to parent coordinates.
template <class S>
Mat3<S> quaternion_E(const S* q) {
  const S &w = q[0], &x = q[1], &y = q[2], &z = q[3], one(1), two(2);
  return {{one - two * (y * y + z * z), two * (x * y + w * z), two * (x * z - w * y)},
          {two * (x * y - w * z), one - two * (x * x + z * z), two * (y * z + w * x)},
          {two * (x * z + w * y), two * (y * z - w * x), one - two * (x * x + y * y)}};
}

// out = q exp(phi), rotation vector phi in child axes [rad]; out may be q. For t = |phi| < 0.1,
// five terms of the power series of sin(t/2)/t are exact to rounding and avoid 0/0.
template <class S>
void integrate_quaternion(const S* q, const S* phi, S* out) {
  using std::sqrt;
  const Vec3<S> u{phi[0], phi[1], phi[2]};
  const S t2 = dot(u, u);
  const auto small = t2 < S(1e-2);
  const S t = sqrt(select(small, S(1), t2));  // if small, the series is used instead
  const SinCos<S> half = sin_cos(t * S(0.5));
  const S x = t2 * S(0.25);  // (t/2)^2
  const S dw = select(
      small,
      S(1) + x * (S(-1.0 / 2) + x * (S(1.0 / 24) + x * (S(-1.0 / 720) + x * S(1.0 / 40320)))),
      half.cos);
  const S half_sinc = select(
      small,
      S(0.5) * (S(1) + x * (S(-1.0 / 6) +
                            x * (S(1.0 / 120) + x * (S(-1.0 / 5040) + x * S(1.0 / 362880))))),
      half.sin / t);
  const Vec3<S> dv = half_sinc * u;

  const S w = q[0];
  const Vec3<S> v{q[1], q[2], q[3]};
  const S new_w = w * dw - dot(v, dv);
  const Vec3<S> new_v = w * dv + dw * v + cross(v, dv);
  const S inverse_norm = S(1) / sqrt(new_w * new_w + dot(new_v, new_v));  // corrects rounding only
  out[0] = new_w * inverse_norm;
  out[1] = new_v.x * inverse_norm;
  out[2] = new_v.y * inverse_norm;
  out[3] = new_v.z * inverse_norm;
}

// Inverse differential of exp on SO(3): d theta/dt for R(t) = R(0) exp(theta(t)) and R' = R [w]x (w
// in body axes), to fourth order in theta:
//   w + theta x w / 2 + theta x (theta x w) / 12 - [theta]x^4 w / 720.
template <class S>
Vec3<S> dexpinv_so3(const Vec3<S>& theta, const Vec3<S>& w) {
  const Vec3<S> once = cross(theta, w), twice = cross(theta, once);
  const Vec3<S> four = cross(theta, cross(theta, twice));
  return w + S(0.5) * once + S(1.0 / 12) * twice - S(1.0 / 720) * four;
}

}  // namespace twinarm
