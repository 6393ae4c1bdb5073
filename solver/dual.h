// Dual<N>: a number and its derivatives in N directions, by forward-mode differentiation.
//
// Comparisons look at the value alone, so that a branch of select() is differentiated as it is.
#pragma once

#include "solver/lanes.h"
#include "solver/scalar.h"

namespace twinarm {

template <int N>
struct alignas(N * sizeof(double)) Dual {
  using Lanes = typename LanesOf<N>::Lanes;
  double value = 0;
  Lanes d{};  // derivatives

  Dual() = default;
  Dual(double x) : value(x) {}  // NOLINT: a constant
  Dual(double x, const Lanes& derivatives) : value(x), d(derivatives) {}
  static Dual variable(double x, int direction) {
    Dual a(x);
    a.d[direction] = 1;
    return a;
  }

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.d + b.d}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.d - b.d}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.d + a.d * b.value};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double inverse = 1 / b.value, quotient = a.value * inverse;
    return {quotient, (a.d - quotient * b.d) * inverse};
  }
  Dual operator-() const { return {-value, -d}; }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }

  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return {root, a.d / (2 * root)};
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
