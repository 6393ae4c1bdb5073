// Batch<N>: N doubles in SIMD lanes; one call of an algorithm computes N states of one model.
//
// Lanes are independent: lane k is bit-identical to a run of its own at the same instruction-set
// level (solver/dynamics/dynamics.h). Exception: if a revolute joint has armature in some lanes
// only, all lanes use the general form of Ia, and results differ by rounding.
#pragma once

#include <cstddef>

#include "solver/spatial/scalar.h"
#include "solver/spatial/simd_vector.h"

namespace twinarm {

template <int N>
struct alignas(N * sizeof(double)) Batch {
  using Lanes = typename LanesOf<N>::Lanes;
  using Mask = typename LanesOf<N>::Mask;

  Lanes lanes{};
  Batch() = default;
  // Broadcasts x to all lanes; x - 0 compiles to one instruction in g++ and clang.
  Batch(double x) : lanes(x - Lanes{}) {}  // NOLINT
  static Batch of(const Lanes& l) {
    Batch b;
    b.lanes = l;
    return b;
  }
  double operator[](int i) const { return lanes[i]; }
  void set(int i, double x) { lanes[i] = x; }

  friend Batch operator+(const Batch& a, const Batch& b) { return of(a.lanes + b.lanes); }
  friend Batch operator-(const Batch& a, const Batch& b) { return of(a.lanes - b.lanes); }
  friend Batch operator*(const Batch& a, const Batch& b) { return of(a.lanes * b.lanes); }
  friend Batch operator/(const Batch& a, const Batch& b) { return of(a.lanes / b.lanes); }
  Batch operator-() const { return of(-lanes); }
  friend Mask operator<(const Batch& a, const Batch& b) { return a.lanes < b.lanes; }

  friend Batch select(const Mask& mask, const Batch& a, const Batch& b) {
    return of(mask ? a.lanes : b.lanes);
  }
  friend Batch sqrt(const Batch& a) {
    Batch root;
    for (int i = 0; i < N; ++i) root.lanes[i] = std::sqrt(a.lanes[i]);
    return root;
  }
  friend bool is_nonzero(const Batch& a) { return any_lane(a.lanes != 0); }
  friend SinCos<Batch> sin_cos(const Batch& x) {
    const SinCos<Lanes> both = sin_cos_polynomial<Lanes, Mask>(x.lanes);
    SinCos<Batch> out{of(both.sin), of(both.cos)};
    const Mask near = (x.lanes <= kPolynomialRange) & (x.lanes >= -kPolynomialRange);
    if (!any_lane(~near)) return out;
    for (int i = 0; i < N; ++i) {  // outside the polynomial's range, or NaN
      const SinCos<double> one = sin_cos(static_cast<double>(x.lanes[i]));
      out.sin.lanes[i] = one.sin;
      out.cos.lanes[i] = one.cos;
    }
    return out;
  }
};
template <int N>
struct ConstantOf<Batch<N>> {
  using type = double;
};

// One lane; a double has one.
inline void set_lane(double& a, std::size_t, double x) {
  a = x;
}
template <int N>
void set_lane(Batch<N>& a, std::size_t lane, double x) {
  a.lanes[lane] = x;
}
inline double lane_of(double a, std::size_t) {
  return a;
}
template <int N>
double lane_of(const Batch<N>& a, std::size_t lane) {
  return a.lanes[lane];
}

}  // namespace twinarm
