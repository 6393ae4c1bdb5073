// Products with small dense blocks, row by row. Compile-time sizes (3 rows of a contact, 6
// velocities of a free body) let the compiler unroll loops, which halves the time. Other shapes use
// run-time sizes with the same order of summation.
#pragma once

#include <cmath>
#include <type_traits>

namespace twinarm {

// f(n), n a compile-time constant for a free body.
template <class F>
void with_size(int n, F&& f) {
  if (n == 6)
    f(std::integral_constant<int, 6>{});
  else
    f(n);
}

// f(rows, n), with compile-time constants for a contact and a free body.
template <class F>
void with_shape(int rows, int n, F&& f) {
  constexpr std::integral_constant<int, 3> three;
  if (rows == 3 && n == 6)
    f(three, std::integral_constant<int, 6>{});
  else if (rows == 3)
    f(three, n);
  else
    f(rows, n);
}

// f(rows, m, n), likewise for two free bodies.
template <class F>
void with_shapes(int rows, int m, int n, F&& f) {
  constexpr std::integral_constant<int, 3> three;
  if (rows == 3 && m == 6 && n == 6)
    f(three, std::integral_constant<int, 6>{}, std::integral_constant<int, 6>{});
  else if (rows == 3)
    f(three, m, n);
  else
    f(rows, m, n);
}

// out = D J, D the leading left x rows block of a 3 x 3 matrix.
template <class Left, class Rows, class N>
inline void product(const double* __restrict D, Left left, const double* __restrict J, Rows rows,
                    N n, double* __restrict out) {
  for (int r = 0; r < left; ++r)
    for (int k = 0; k < n; ++k) {
      double sum = 0;
      for (int s = 0; s < rows; ++s) sum += D[r * 3 + s] * J[s * n + k];
      out[r * n + k] = sum;
    }
}

// to(r)[0 .. width(r)) += row r of A^T B for r < m; A is rows x m, B is rows x n.
template <class Rows, class M, class N, class To, class Width>
inline void add_product_rows(const double* __restrict A, M m, const double* __restrict B, N n,
                             Rows rows, To&& to, Width&& width) {
  for (int r = 0; r < m; ++r) {
    double* __restrict out = to(r);
    const int w = width(r);
    for (int k = 0; k < w; ++k) {
      double sum = 0;
      for (int q = 0; q < rows; ++q) sum += A[q * m + r] * B[q * n + k];
      out[k] += sum;
    }
  }
}

// u += J v
template <class Rows, class N>
inline void add_product(const double* J, Rows rows, N n, const double* v, double* u) {
  double sum[3] = {};
  for (int k = 0; k < n; ++k)
    for (int r = 0; r < rows; ++r) sum[r] += J[r * n + k] * v[k];
  for (int r = 0; r < rows; ++r) u[r] += sum[r];
}

// f += J^T p
template <class Rows, class N>
inline void add_transposed_product(const double* __restrict J, Rows rows, N n, const double* p,
                                   double* __restrict f) {
  for (int k = 0; k < n; ++k) {
    double sum = 0;
    for (int r = 0; r < rows; ++r) sum += J[r * n + k] * p[r];
    f[k] += sum;
  }
}

// b := (L L^T)^-1 b, with 1 / l_rr on the diagonal of L.
template <class N>
inline void solve_cholesky(const double* __restrict L, N n, double* __restrict b) {
  for (int r = 0; r < n; ++r) {
    for (int k = 0; k < r; ++k) b[r] -= L[r * n + k] * b[k];
    b[r] *= L[r * n + r];
  }
  for (int r = n; r-- > 0;) {
    b[r] *= L[r * n + r];
    for (int k = 0; k < r; ++k) b[k] -= L[r * n + k] * b[r];
  }
}

// Cholesky factor L of A, with 1 / l_rr on the diagonal; false if A is not positive definite.
template <class N>
inline bool cholesky(const double* __restrict A, N n, double* __restrict L) {
  bool positive = true;
  for (int r = 0; r < n; ++r)
    for (int j = 0; j <= r; ++j) {
      double rest = A[r * n + j];
      for (int k = 0; k < j; ++k) rest -= L[r * n + k] * L[j * n + k];
      L[r * n + j] = j < r ? rest * L[j * n + j] : 1 / std::sqrt(rest);
      positive = positive && (j < r || rest > 0);
    }
  return positive;
}

}  // namespace twinarm
