// L D L^T of a small dense symmetric positive definite matrix, in place and without pivoting.
// No allocation after the constructor.
#pragma once

#include <cstddef>
#include <vector>

namespace twinarm {

class DenseSpd {
 public:
  explicit DenseSpd(std::size_t capacity) : capacity_(capacity), A_(capacity * capacity) {}
  // factorise() reads the lower triangle of the leading n x n block; false: not positive definite.
  double& operator()(std::size_t row, std::size_t column) { return A_[row * capacity_ + column]; }
  double operator()(std::size_t row, std::size_t column) const {
    return A_[row * capacity_ + column];
  }
  bool factorise(std::size_t n) {
    DenseSpd& A = *this;
    n_ = n;
    bool positive = true;
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = j; i < n; ++i) {
        for (std::size_t k = 0; k < j; ++k) A(i, j) -= A(i, k) * A(j, k) * A(k, k);
        if (i > j) A(i, j) /= A(j, j);
        if (i == j) positive = positive && A(j, j) > 0;
      }
    return positive;
  }
  void solve(double* b) const {  // b := A^-1 b
    const DenseSpd& A = *this;
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t k = 0; k < i; ++k) b[i] -= A(i, k) * b[k];
    for (std::size_t i = n_; i-- > 0;) {
      b[i] /= A(i, i);
      for (std::size_t k = i + 1; k < n_; ++k) b[i] -= A(k, i) * b[k];
    }
  }

 private:
  std::size_t capacity_, n_ = 0;
  std::vector<double> A_;
};

}  // namespace twinarm
