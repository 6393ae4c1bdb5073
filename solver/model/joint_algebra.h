// Dense algebra of one joint: vectors and symmetric matrices of size n = nv of the joint.
#pragma once

#include <array>
#include <cstddef>

namespace twinarm {

template <class S, std::size_t n>
using VecN = std::array<S, n>;
template <class S, std::size_t n>
using MatN = std::array<std::array<S, n>, n>;

template <class S, std::size_t n>
VecN<S, n> operator-(const VecN<S, n>& a, const VecN<S, n>& b) {
  VecN<S, n> difference;
  for (std::size_t k = 0; k < n; ++k) difference[k] = a[k] - b[k];
  return difference;
}
template <class S, std::size_t n>
VecN<S, n> operator+(VecN<S, n> a, const VecN<S, n>& b) {
  for (std::size_t k = 0; k < n; ++k) a[k] = a[k] + b[k];
  return a;
}
template <class S, std::size_t n>
VecN<S, n> unit_vector(std::size_t k) {
  VecN<S, n> e;
  for (std::size_t i = 0; i < n; ++i) e[i] = S(i == k ? 1 : 0);
  return e;
}

// L D L^T of a symmetric positive definite matrix without pivoting. Used for D_i = S_i^T IA_i S_i,
// which is positive definite if body i and its descendants have inertia about the joint.
template <class S, std::size_t n>
struct Spd {
  std::array<S, n*(n - (n > 0 ? 1 : 0)) / 2> L;  // strictly lower triangle, row-major
  VecN<S, n> inverse_d;
};
inline constexpr std::size_t row_of_L(std::size_t i) {
  return i * (i - (i > 0 ? 1 : 0)) / 2;
}
template <class S, std::size_t n>
Spd<S, n> factorized(const MatN<S, n>& A) {
  Spd<S, n> f;
  VecN<S, n> d;
  for (std::size_t j = 0; j < n; ++j) {
    d[j] = A[j][j];
    for (std::size_t k = 0; k < j; ++k) {
      const S& l = f.L[row_of_L(j) + k];
      d[j] = d[j] - l * l * d[k];
    }
    f.inverse_d[j] = S(1) / d[j];
    for (std::size_t i = j + 1; i < n; ++i) {
      S l = A[i][j];
      for (std::size_t k = 0; k < j; ++k)
        l = l - f.L[row_of_L(i) + k] * f.L[row_of_L(j) + k] * d[k];
      f.L[row_of_L(i) + j] = l * f.inverse_d[j];
    }
  }
  return f;
}
// A^-1 b
template <class S, std::size_t n>
VecN<S, n> solve(const Spd<S, n>& f, VecN<S, n> b) {
  for (std::size_t i = 1; i < n; ++i)
    for (std::size_t k = 0; k < i; ++k) b[i] = b[i] - f.L[row_of_L(i) + k] * b[k];
  for (std::size_t i = n; i-- > 0;) {
    b[i] = b[i] * f.inverse_d[i];
    for (std::size_t k = i + 1; k < n; ++k) b[i] = b[i] - f.L[row_of_L(k) + i] * b[k];
  }
  return b;
}

}  // namespace twinarm
