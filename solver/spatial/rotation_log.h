// Logarithm of SO(3): rotation vector of a rotation matrix, for scalars with lanes. Angle in
// [0, pi]; at pi either sign of the axis.
//
// With T = 1 + tr R = 4 cos^2(phi / 2) and the axial vector u = 2 sin(phi) * axis of R,
//   phi axis = f(4 - T) u,   f = phi / (2 sin phi).
// f is a polynomial up to 45 degrees. For larger angles the quaternion is computed from its largest
// component, without cancellation near pi.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "solver/spatial/spatial.h"

namespace twinarm {

// phi / (2 sin phi) as a polynomial of t = 4 sin^2(phi / 2), t <= 0.588, exact to rounding;
// interpolates at Chebyshev points.
template <class S>
S half_angle_over_sine(const S& t) {
  constexpr std::array<double, 12> c{
      7.544864801663231e-08, 4.87790832458816e-08,  6.17590303419651e-07,   2.240565232768444e-06,
      9.729544549290022e-06, 4.162075796079643e-05, 0.00018037588401229585, 0.0007936507209106702,
      0.0035714285758257002, 0.016666666666531462,  0.0833333333333349,     0.5};
  const S t2 = t * t;
  S odd(c[0]), even(c[1]);  // two independent Horner chains
  for (std::size_t i = 2; i < c.size(); i += 2) {
    odd = odd * t2 + S(c[i]);
    even = even * t2 + S(c[i + 1]);
  }
  return even + odd * t;
}

// atan2(y, x) for x, y >= 0, not both zero: rational approximation of the Cephes library (Moshier
// 1989), exact to rounding.
template <class S>
S arctangent(const S& y, const S& x) {
  constexpr std::array<double, 5> p{-8.750608600031904122785e-1, -1.615753718733365076637e1,
                                    -7.500855792314704667340e1, -1.228866684490136173410e2,
                                    -6.485021904942025371773e1};
  constexpr std::array<double, 6> q{1,
                                    2.485846490142306297962e1,
                                    1.650270098316988542046e2,
                                    4.328810604912902668951e2,
                                    4.853903996359136964868e2,
                                    1.945506571482613964425e2};
  const auto first = y < S(0.66) * x, last = S(2.414213562373095) * x < y;
  const S over = select(first, y, select(last, -x, y - x));
  const S under = select(first, x, select(last, y, x + y));
  const S from = select(first, S(0), select(last, S(1.5707963267948966), S(0.78539816339744831)));
  const S r = over / under, z = r * r;
  S above(p[0]), below(q[0]);
  for (std::size_t i = 1; i < p.size(); ++i) above = above * z + S(p[i]);
  for (std::size_t i = 1; i < q.size(); ++i) below = below * z + S(q[i]);
  return from + (r + r * z * (above / below));
}

template <class S>
Vec3<S> select(const decltype(S(0) < S(0))& mask, const Vec3<S>& a, const Vec3<S>& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

// Any angle, from the largest of w^2, x^2, y^2, z^2; four times these are T and `squares`.
template <class S>
Vec3<S> rotation_vector_by_quaternion(const Mat3<S>& R, const S& T, const Vec3<S>& u) {
  using std::sqrt;
  const S one(1);
  const Vec3<S> squares{one + R.r0.x - R.r1.y - R.r2.z, one - R.r0.x + R.r1.y - R.r2.z,
                        one - R.r0.x - R.r1.y + R.r2.z};
  const S xy = R.r0.y + R.r1.x, xz = R.r0.z + R.r2.x, yz = R.r1.z + R.r2.y;
  const auto y_max = squares.x < squares.y;
  S w = select(y_max, u.y, u.x), max = select(y_max, squares.y, squares.x);
  Vec3<S> v = select<S>(y_max, {xy, squares.y, yz}, {squares.x, xy, xz});
  const auto z_max = max < squares.z;
  v = select<S>(z_max, {xz, yz, squares.z}, v);
  w = select(z_max, u.z, w), max = select(z_max, squares.z, max);
  const auto w_max = max < T;
  v = select<S>(w_max, u, v);
  w = select(w_max, T, w);
  const auto negative = w < S(0);  // q and -q are the same rotation: angle in [0, pi]
  v = select<S>(negative, -v, v);
  w = select(negative, -w, w);
  const S s = sqrt(dot(v, v));
  return (S(2) * arctangent(s, w) / s) * v;
}

template <class S>
Vec3<S> rotation_vector(const Mat3<S>& R) {
  const Vec3<S> u{R.r2.y - R.r1.z, R.r0.z - R.r2.x, R.r1.x - R.r0.y};
  const S T = S(1) + R.r0.x + R.r1.y + R.r2.z;
  const auto is_near = S(3.4143) < T;
  const Vec3<S> phi = half_angle_over_sine(S(4) - T) * u;
  if (!any_lane(~is_near)) return phi;
  return select<S>(is_near, phi, rotation_vector_by_quaternion(R, T, u));
}

}  // namespace twinarm
