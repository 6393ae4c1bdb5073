// The n numbers (or forces) of one joint, out of and into the arrays of the whole mechanism.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "solver/joint.h"

namespace twinarm {

template <std::size_t n, class T>
std::array<T, n> slice(const std::vector<T>& all, std::size_t first) {
  std::array<T, n> part{};
  for (std::size_t k = 0; k < n; ++k) part[k] = all[first + k];
  return part;
}
template <std::size_t n, class S>
MatN<S, n> slice_matrix(const std::vector<S>& all, std::size_t first) {
  MatN<S, n> part{};
  for (std::size_t k = 0; k < n; ++k) part[k] = slice<n>(all, first + k * n);
  return part;
}
template <class T, std::size_t n>
void store(const std::array<T, n>& part, std::vector<T>& all, std::size_t first) {
  for (std::size_t k = 0; k < n; ++k) all[first + k] = part[k];
}
template <class S, std::size_t n>
void store_matrix(const MatN<S, n>& part, std::vector<S>& all, std::size_t first) {
  for (std::size_t k = 0; k < n; ++k) store(part[k], all, first + k * n);
}
template <class S, std::size_t n>
VecN<S, n> minus(const VecN<S, n>& a, const VecN<S, n>& b) {
  VecN<S, n> difference{};
  for (std::size_t k = 0; k < n; ++k) difference[k] = a[k] - b[k];
  return difference;
}
template <class S, std::size_t n>
MatN<S, n> plus_diagonal(MatN<S, n> A, const std::vector<S>& all, std::size_t first) {
  for (std::size_t k = 0; k < n; ++k) A[k][k] = A[k][k] + all[first + k];
  return A;
}

}  // namespace twinarm
