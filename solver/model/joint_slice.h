// Load and store the n entries of one joint in the arrays of the whole model.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "solver/model/joint_algebra.h"

namespace twinarm {

template <std::size_t n, class T>
std::array<T, n> slice(const std::vector<T>& all, std::size_t first) {
  std::array<T, n> part;
  for (std::size_t k = 0; k < n; ++k) part[k] = all[first + k];
  return part;
}
template <class T, std::size_t n>
void store(const std::array<T, n>& part, std::vector<T>& all, std::size_t first) {
  for (std::size_t k = 0; k < n; ++k) all[first + k] = part[k];
}
// Row-major.
template <class S, std::size_t n>
void store(const MatN<S, n>& part, std::vector<S>& all, std::size_t first) {
  for (std::size_t k = 0; k < n; ++k) store(part[k], all, first + k * n);
}
template <class S, std::size_t n>
bool is_stored(const MatN<S, n>& part, const std::vector<S>& all, std::size_t first) {
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j)
      if (part[k][j] != all[first + k * n + j]) return false;
  return true;
}
template <class S, std::size_t n>
void add_to_diagonal(MatN<S, n>& A, const std::vector<S>& d1, const std::vector<S>& d2,
                     std::size_t first) {
  for (std::size_t k = 0; k < n; ++k) A[k][k] = A[k][k] + d1[first + k] + d2[first + k];
}
// A factorization has n (n + 1) / 2 entries: 1/d, then the rows of L.
template <class S, std::size_t n>
void store(const Spd<S, n>& part, std::vector<S>& all, std::size_t first) {
  store(part.inverse_d, all, first);
  for (std::size_t k = 0; k < row_of_L(n); ++k) all[first + n + k] = part.L[k];
}
template <std::size_t n, class R, class S>
Spd<R, n> slice_spd(const std::vector<S>& all, std::size_t first) {
  Spd<R, n> part;
  for (std::size_t k = 0; k < n; ++k) part.inverse_d[k] = R(all[first + k]);
  for (std::size_t k = 0; k < row_of_L(n); ++k) part.L[k] = R(all[first + n + k]);
  return part;
}

}  // namespace twinarm
