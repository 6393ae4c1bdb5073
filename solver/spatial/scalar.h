// Requirements on the scalar S of the algorithms, and their implementation for double.
//
// S is double, Dual<N> (solver/spatial/dual.h) or Batch<N> (solver/spatial/batch.h). The algorithms
// use + - * /, sqrt, select, is_nonzero and sin_cos; they never branch on a value of S.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <type_traits>

namespace twinarm {

inline constexpr double kDegree = std::numbers::pi / 180;  // [rad]

// condition ? a : b, per lane. Both sides are evaluated.
template <class S>
S select(bool condition, const S& a, const S& b) {
  return condition ? a : b;
}

// False only if x is zero in value, all lanes and derivatives: work with result zero is skipped.
inline bool is_nonzero(double x) {
  return x != 0;
}

// Scalar type of values that are equal in all lanes of S; S itself if it has no lanes.
template <class S>
struct ConstantOf {
  using type = S;
};
template <class S>
using Constant = typename ConstantOf<S>::type;

template <class S>
struct SinCos {
  S sin, cos;
};

// Sine and cosine to 1.6 ulp for |x| <= 200: Cody-Waite reduction to [-pi/4, pi/4] in three parts,
// minimax polynomials of fdlibm. Branch-free: 3 to 4 times as fast as libm, and valid for SIMD
// vectors. T: floating-point number or vector, I: integer type of the same size.
template <class T, class I>
SinCos<T> sin_cos_polynomial(const T& x) {
  constexpr double round_by_adding = 6755399441055744.0;  // 1.5 * 2^52: leaves the integer part
  const T shifted = x * 0.63661977236758134308 + round_by_adding;
  I quadrant;
  std::memcpy(&quadrant, &shifted, sizeof quadrant);
  const T n = shifted - round_by_adding;
  T r = x - n * 1.57079632673412561417e+00;
  r = r - n * 6.07710050630396597660e-11;
  r = r - n * 2.02226624879595063154e-21;

  const T z = r * r;
  const T s =
      r + r * z *
              (-1.66666666666666324348e-01 +
               z * (8.33333333332248946124e-03 +
                    z * (-1.98412698298579493134e-04 +
                         z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 +
                                                                z * 1.58969099521155010221e-10)))));
  const T c =
      1.0 - 0.5 * z +
      z * z *
          (4.16666666666666019037e-02 +
           z * (-1.38888888888741095749e-03 +
                z * (2.48015872894767294178e-05 +
                     z * (-2.75573143513906633035e-07 +
                          z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));

  // Odd quadrants swap sine and cosine; the sign depends on the quadrant.
  const I odd = -(quadrant & 1), sign_s = (quadrant & 2) << 62, sign_c = ((quadrant + 1) & 2) << 62;
  I bits_s, bits_c;
  std::memcpy(&bits_s, &s, sizeof bits_s);
  std::memcpy(&bits_c, &c, sizeof bits_c);
  const I out_s = ((bits_s & ~odd) | (bits_c & odd)) ^ sign_s;
  const I out_c = ((bits_c & ~odd) | (bits_s & odd)) ^ sign_c;
  SinCos<T> out;
  std::memcpy(&out.sin, &out_s, sizeof out_s);
  std::memcpy(&out.cos, &out_c, sizeof out_c);
  return out;
}

inline constexpr double kPolynomialRange = 200;  // [rad]

// Whether sines of all coordinates are precomputed in SIMD lanes (solver/spatial/sincos_batch.h).
template <class S>
inline constexpr bool precomputes_sincos = std::is_same_v<S, double>;

inline SinCos<double> sin_cos(double x) {
  if (std::abs(x) <= kPolynomialRange) return sin_cos_polynomial<double, std::int64_t>(x);
  return {std::sin(x), std::cos(x)};  // outside the polynomial's range, or NaN
}

}  // namespace twinarm
