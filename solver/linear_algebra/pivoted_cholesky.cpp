#include "solver/linear_algebra/pivoted_cholesky.h"

#include <cmath>

namespace twinarm {

PivotedCholesky::PivotedCholesky(std::size_t capacity)
    : capacity_(capacity),
      A_(capacity * capacity),
      L_(capacity * capacity),
      scale_(capacity),
      left_(capacity) {
  chosen_.reserve(capacity);
}

void PivotedCholesky::factorise(std::size_t n, double tolerance, const double* size) noexcept {
  n_ = n;
  chosen_.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const double left = A_[i * capacity_ + i], d = size ? size[i] : left;
    scale_[i] = d > 0 ? 1 / std::sqrt(d) : d == 0 ? 0 : d;  // propagates NaN
    left_[i] = d == 0 ? 0 : std::isnan(left / d) ? 1 : left / d;
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
  const double root = std::sqrt(left_[pivot]), inverse = 1 / root;
  const double* of_pivot = &L_[pivot * capacity_];
  for (std::size_t i = 0; i < n_; ++i) {
    double* row = &L_[i * capacity_];
    if (i == pivot || left_[i] <= 0) continue;  // chosen, or zero
    double sum = scale_[i] * A_[i * capacity_ + pivot] * scale_[pivot];
    for (std::size_t j = 0; j < k; ++j) sum -= row[j] * of_pivot[j];
    row[k] = sum * inverse;
    left_[i] -= row[k] * row[k];
    if (left_[i] < 0) left_[i] = 0;
  }
  L_[pivot * capacity_ + k] = root;
  left_[pivot] = -1;  // chosen
  chosen_.push_back(pivot);
}

}  // namespace twinarm
