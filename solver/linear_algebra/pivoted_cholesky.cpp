#include "solver/linear_algebra/pivoted_cholesky.h"

#include <cmath>

namespace twinarm {

PivotedCholesky::PivotedCholesky(std::size_t capacity)
    : capacity_(capacity),
      A_(capacity * capacity),
      L_(capacity * capacity),
      scale_(capacity),
      left_(capacity),
      y_(capacity) {
  chosen_.reserve(capacity);
}

void PivotedCholesky::factorise(std::size_t n, double tolerance) noexcept {
  n_ = n;
  chosen_.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const double d = A_[i * capacity_ + i];
    scale_[i] = d > 0 ? 1 / std::sqrt(d) : d == 0 ? 0 : d;  // propagates NaN
    left_[i] = d == 0 ? 0 : 1;
  }
  while (chosen_.size() < n) {
    std::size_t pivot = 0;
    for (std::size_t i = 1; i < n; ++i)
      if (left_[i] > left_[pivot]) pivot = i;
    if (!(left_[pivot] > tolerance)) break;
    add_column(pivot);
  }
}

// Computes the next column of L.
void PivotedCholesky::add_column(std::size_t pivot) noexcept {
  const std::size_t k = chosen_.size();
  const double root = std::sqrt(left_[pivot]);
  const double* of_pivot = &L_[pivot * capacity_];
  for (std::size_t i = 0; i < n_; ++i) {
    double* row = &L_[i * capacity_];
    if (i == pivot || left_[i] < 0) continue;
    double sum = scale_[i] * A_[i * capacity_ + pivot] * scale_[pivot];
    for (std::size_t j = 0; j < k; ++j) sum -= row[j] * of_pivot[j];
    row[k] = sum / root;
    left_[i] -= row[k] * row[k];
    if (left_[i] < 0) left_[i] = 0;
  }
  L_[pivot * capacity_ + k] = root;
  left_[pivot] = -1;  // chosen
  chosen_.push_back(pivot);
}

void PivotedCholesky::solve(double* b) const noexcept {
  const std::size_t r = chosen_.size();
  for (std::size_t k = 0; k < r; ++k) {
    const std::size_t p = chosen_[k];
    double sum = scale_[p] * b[p];
    for (std::size_t j = 0; j < k; ++j) sum -= L(p, j) * y_[j];
    y_[k] = sum / L(p, k);
  }
  for (std::size_t i = 0; i < n_; ++i) b[i] = 0;
  for (std::size_t k = r; k-- > 0;) {
    double sum = y_[k];
    for (std::size_t j = k + 1; j < r; ++j) sum -= L(chosen_[j], k) * y_[j];
    y_[k] = sum / L(chosen_[k], k);
  }
  for (std::size_t k = 0; k < r; ++k) b[chosen_[k]] = scale_[chosen_[k]] * y_[k];
}

}  // namespace twinarm
