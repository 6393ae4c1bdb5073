// Sines and cosines of all coordinates of a mechanism, ahead of the pass that needs them.
//
// As many side by side as a register holds, and to the bit what sin_cos gives one by one. In the
// pass itself each would be the beginning of a chain of sixty cycles. Coordinates that are no
// angles are taken along: that costs less than to sort them out.
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

// In groups of N, the last of which may overlap the one before; of fewer than N, in smaller groups.
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

// Valid where |q| <= kPolynomialRange (joint_transform asks). Other scalars than double are not
// taken ahead: lanes are side by side already.
template <class S>
void precompute_sincos(const std::vector<S>& q, std::vector<S>& sin, std::vector<S>& cos) {
  if constexpr (precomputes_sincos<S>)
    sin_cos_in_groups<kNativeLanes>(q.size(), q.data(), sin.data(), cos.data());
}

}  // namespace twinarm::TWINARM_ISA
