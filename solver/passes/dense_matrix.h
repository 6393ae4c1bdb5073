// Operations of the matrices nv x nv of the algorithms, row-major, at their instruction-set level.
#pragma once

#include <algorithm>
#include <vector>

#include "solver/spatial/instruction_set.h"

namespace twinarm::TWINARM_ISA {

// C = A B, A: n x n, B: n x m, row-major. Four rows at a time: each entry that is loaded from B is
// used four times.
template <class S>
void multiply(const std::vector<S>& A, const std::vector<S>& B, std::size_t n, std::size_t m,
              std::vector<S>& C) {
  std::ranges::fill(C, S(0));
  std::size_t k = 0;
  for (; k + 4 <= n; k += 4)
    for (std::size_t i = 0; i < n; ++i) {
      const S a0 = A[i * n + k], a1 = A[i * n + k + 1], a2 = A[i * n + k + 2],
              a3 = A[i * n + k + 3];
      const S *const b0 = &B[k * m], *const b1 = b0 + m, *const b2 = b1 + m, *const b3 = b2 + m;
      S* const c = &C[i * m];
      TWINARM_INDEPENDENT
      for (std::size_t j = 0; j < m; ++j)
        c[j] = c[j] + (a0 * b0[j] + a1 * b1[j] + (a2 * b2[j] + a3 * b3[j]));
    }
  for (; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i) {
      const S a = A[i * n + k];
      const S* const b = &B[k * m];
      S* const c = &C[i * m];
      TWINARM_INDEPENDENT
      for (std::size_t j = 0; j < m; ++j) c[j] = c[j] + a * b[j];
    }
}

// Copies the given triangle of a symmetric matrix to the other, in blocks of a cache line.
enum class Triangle { lower, upper };
template <Triangle given, class S>
void mirror_triangle(std::size_t n, S* M) {
  constexpr std::size_t kBlock = 8;
  for (std::size_t i0 = 0; i0 < n; i0 += kBlock)
    for (std::size_t j0 = 0; j0 <= i0; j0 += kBlock)
      for (std::size_t i = i0; i < std::min(n, i0 + kBlock); ++i)
        for (std::size_t j = j0; j < std::min(i, j0 + kBlock); ++j)
          if constexpr (given == Triangle::lower)
            M[j * n + i] = M[i * n + j];
          else
            M[i * n + j] = M[j * n + i];
}

}  // namespace twinarm::TWINARM_ISA
