// Dual<N>: a number and its derivatives in N directions, by forward-mode differentiation.
//
// Comparisons look at the value alone, so that a branch of select() is differentiated as it is.
#pragma once

#include "solver/spatial/scalar.h"
#include "solver/spatial/simd_vector.h"

// Where a product takes a dozen instructions (SSE2), it is called: a third of the code, of the time
// to compile it, and by half slower than inlined. Above that all is inlined
// (tests/lint/test_levels.py).
#if defined(__AVX__)
#define TWINARM_DUAL_OPERATION
#else
#define TWINARM_DUAL_OPERATION [[gnu::noinline]]
#endif

namespace twinarm {

// N doubles, halved until they fit the vectors of the processor: g++ 12 keeps those in registers,
// but lowers wider ones through memory, one number after the other. The bytes are the same at every
// level of the instruction set, and only the passes, which have a namespace for each, compute with
// it there.
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
  // A vector's lanes may be reached as what they are: doubles, one after the other.
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
  static Dual variable(double x, int direction) {
    Dual a(x);
    a.d[direction] = 1;
    return a;
  }

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
