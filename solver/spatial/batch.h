// Batch<N>: N doubles side by side, so that one call of a pass computes N states of one model.
//
// Lanes never mix, so lane k gives the same as a run of its own (to the bit, at one level of the
// instruction set; solver/dynamics/dynamics.h). By rounding only where a hinge has armature in some
// lanes and none in others: all of them then take the way of a geared hinge.
#pragma once

#include "solver/spatial/scalar.h"
#include "solver/spatial/simd_vector.h"

namespace twinarm {

template <int N>
struct alignas(N * sizeof(double)) Batch {
  using Lanes = typename LanesOf<N>::Lanes;
  using Mask = typename LanesOf<N>::Mask;

  Lanes lanes{};
  Batch() = default;
  // A scalar stands for itself in every lane; x - 0 is x, and one instruction to both compilers.
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
    for (int i = 0; i < N; ++i) {  // far out, and NaN
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

}  // namespace twinarm
