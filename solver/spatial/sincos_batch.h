// Sines and cosines of all coordinates of a model, computed in SIMD lanes before pass 1.
//
// Bit-identical to sin_cos() per coordinate. Within pass 1 each would start a dependency chain of
// 60 cycles. Coordinates that are not angles are computed too: cheaper than selecting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "solver/spatial/instruction_set.h"
#include "solver/spatial/scalar.h"
#include "solver/spatial/simd_vector.h"

namespace twinarm::TWINARM_ISA {

template <int N>
void sin_cos_side_by_side(const double* x, double* sin, double* cos) {
  using Lanes = typename LanesOf<N>::Lanes;
  Lanes lanes;
  std::memcpy(&lanes, x, sizeof lanes);
  const SinCos<Lanes> both = sin_cos_polynomial<Lanes, typename LanesOf<N>::Mask>(lanes);
  std::memcpy(sin, &both.sin, sizeof both.sin);
  std::memcpy(cos, &both.cos, sizeof both.cos);
}

// Groups of N; the last may overlap the one before. For n < N: groups of N/2.
template <int N>
void sin_cos_in_groups(std::size_t n, const double* x, double* sin, double* cos) {
  if (n >= N) {
    for (std::size_t k = 0; k + N < n; k += N) sin_cos_side_by_side<N>(x + k, sin + k, cos + k);
    sin_cos_side_by_side<N>(x + (n - N), sin + (n - N), cos + (n - N));
  } else if constexpr (N > 2) {
    sin_cos_in_groups<N / 2>(n, x, sin, cos);
  } else if (n == 1) {
    const SinCos<double> both = sin_cos_polynomial<double, std::int64_t>(x[0]);
    sin[0] = both.sin, cos[0] = both.cos;
  }
}

// Valid for |q| <= kPolynomialRange (checked by joint_transform). Only for double: a Batch already
// fills the lanes.
template <class S>
void precompute_sincos(const std::vector<S>& q, std::vector<S>& sin, std::vector<S>& cos) {
  if constexpr (precomputes_sincos<S>)
    sin_cos_in_groups<kNativeLanes>(q.size(), q.data(), sin.data(), cos.data());
}

}  // namespace twinarm::TWINARM_ISA
