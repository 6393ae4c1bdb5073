// The free joint's transform and its integration on SE(3). Included by solver/joint.h.
#pragma once

namespace twinarm {

// E of a unit quaternion (w, x, y, z) that turns body into parent coordinates: E = R^T.
template <class S>
Mat3<S> quaternion_E(const S& w, const S& x, const S& y, const S& z) {
  const S one(1), two(2);
  return {{one - two * (y * y + z * z), two * (x * y + w * z), two * (x * z - w * y)},
          {two * (x * y - w * z), one - two * (x * x + z * z), two * (y * z + w * x)},
          {two * (x * z + w * y), two * (y * z - w * x), one - two * (x * x + y * y)}};
}

template <class S>
Transform<S> FreeJoint<S>::XJ(const S* q) {
  return {quaternion_E(q[3], q[4], q[5], q[6]), {q[0], q[1], q[2]}};
}

// exp of (turn; shift) on SE(3): rotation by |turn| about turn, translation
//   V shift,  V = 1 + (1 - cos t)/t^2 [turn]x + (t - sin t)/t^3 [turn]x^2.
// sinc and the two coefficients are even power series in t: below 1e-2 three terms are exact to
// rounding, and there is no 0/0.
template <class S>
void FreeJoint<S>::integrate(const S* q, const S* shift, S* out) {
  using std::cos, std::sin, std::sqrt;
  const Vec3<S> turn{shift[0], shift[1], shift[2]}, along{shift[3], shift[4], shift[5]};
  const S t2 = dot(turn, turn), t = sqrt(t2);
  const auto small = t < S(1e-2);
  const S half_sinc = select(small, S(0.5) - t2 / S(48) + t2 * t2 / S(3840), sin(t / S(2)) / t);
  const S b = select(small, S(0.5) - t2 / S(24) + t2 * t2 / S(720), (S(1) - cos(t)) / t2);
  const S c = select(small, S(1) / S(6) - t2 / S(120) + t2 * t2 / S(5040), (t - sin(t)) / (t2 * t));

  const Vec3<S> turn_x_along = cross(turn, along);
  const Vec3<S> p_body = along + b * turn_x_along + c * cross(turn, turn_x_along);
  const Vec3<S> p = transpose_times(quaternion_E(q[3], q[4], q[5], q[6]), p_body);
  out[0] = q[0] + p.x;
  out[1] = q[1] + p.y;
  out[2] = q[2] + p.z;

  const S dw = cos(t / S(2));
  const Vec3<S> dv = half_sinc * turn;
  const S w = q[3];
  const Vec3<S> v{q[4], q[5], q[6]};
  const S new_w = w * dw - dot(v, dv);
  const Vec3<S> new_v = w * dv + dw * v + cross(v, dv);
  const S norm = sqrt(new_w * new_w + dot(new_v, new_v));  // takes away rounding only
  out[3] = new_w / norm;
  out[4] = new_v.x / norm;
  out[5] = new_v.y / norm;
  out[6] = new_v.z / norm;
}

template <class S>
VecN<S, 6> FreeJoint<S>::dexpinv(const VecN<S, 6>& theta, const VecN<S, 6>& qd) {
  const Motion<S> th = times(AllAxes{}, theta), v = times(AllAxes{}, qd);
  const Motion<S> th_v = crm(th, v);
  const Motion<S> rate = v + S(0.5) * th_v + S(1.0 / 12.0) * crm(th, th_v);
  return {rate.w.x, rate.w.y, rate.w.z, rate.v.x, rate.v.y, rate.v.z};
}

}  // namespace twinarm
