// Dual<N>: value and derivatives in N directions (forward-mode automatic differentiation).
//
// Comparisons use the value only: select() returns the derivatives of the selected branch.
#pragma once

#include "solver/spatial/scalar.h"
#include "solver/spatial/simd_vector.h"

// With SSE2 a product takes a dozen instructions and is not inlined: a third of the code size and
// compile time, 1.5 times the run time. With AVX all operations are inlined
// (tests/lint/test_levels.py).
#if defined(__AVX__)
#define TWINARM_DUAL_OPERATION
#else
#define TWINARM_DUAL_OPERATION [[gnu::noinline]]
#endif

namespace twinarm {

// N doubles, split in halves that fit a vector register: g++ 12 lowers wider vectors through
// memory, element by element. The memory layout is the same at every instruction-set level.
template <int N, bool fits = (N <= kNativeLanes)>
struct Tangents {
  Tangents<N / 2> low{}, high{};
  friend Tangents operator+(const Tangents& a, const Tangents& b) {
    return {a.low + b.low, a.high + b.high};
  }
  friend Tangents operator-(const Tangents& a, const Tangents& b) {
    return {a.low - b.low, a.high - b.high};
  }
  friend Tangents operator*(double s, const Tangents& a) { return {s * a.low, s * a.high}; }
  friend Tangents operator-(const Tangents& a) { return {-a.low, -a.high}; }
  double& operator[](int i) { return i < N / 2 ? low[i] : high[i - N / 2]; }
  double operator[](int i) const { return i < N / 2 ? low[i] : high[i - N / 2]; }
};
template <int N>
struct Tangents<N, true> {
  typename LanesOf<N>::Lanes lanes{};
  friend Tangents operator+(const Tangents& a, const Tangents& b) { return {a.lanes + b.lanes}; }
  friend Tangents operator-(const Tangents& a, const Tangents& b) { return {a.lanes - b.lanes}; }
  friend Tangents operator*(double s, const Tangents& a) { return {s * a.lanes}; }
  friend Tangents operator-(const Tangents& a) { return {-a.lanes}; }
  // GCC and clang permit access to the lanes of a vector as consecutive doubles.
  double& operator[](int i) { return reinterpret_cast<double*>(&lanes)[i]; }
  double operator[](int i) const { return lanes[i]; }
};

template <int N>
struct alignas(N * sizeof(double)) Dual {
  Tangents<N> d;  // derivatives
  double value = 0;

  Dual() = default;
  Dual(double x) : value(x) {}  // NOLINT: a constant
  Dual(double x, const Tangents<N>& derivatives) : d(derivatives), value(x) {}

  TWINARM_DUAL_OPERATION friend Dual operator+(const Dual& a, const Dual& b) {
    return {a.value + b.value, a.d + b.d};
  }
  TWINARM_DUAL_OPERATION friend Dual operator-(const Dual& a, const Dual& b) {
    return {a.value - b.value, a.d - b.d};
  }
  TWINARM_DUAL_OPERATION friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.d + b.value * a.d};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double inverse = 1 / b.value, quotient = a.value * inverse;
    return {quotient, inverse * (a.d - quotient * b.d)};
  }
  Dual operator-() const { return {-value, -d}; }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }

  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return {root, (1 / (2 * root)) * a.d};
  }
  friend bool is_nonzero(const Dual& a) {
    bool any = a.value != 0;
    for (int i = 0; i < N; ++i) any = any | (a.d[i] != 0);
    return any;
  }
  friend SinCos<Dual> sin_cos(const Dual& x) {
    const SinCos<double> at = sin_cos(x.value);
    return {{at.sin, at.cos * x.d}, {at.cos, -at.sin * x.d}};
  }
};

}  // namespace twinarm
