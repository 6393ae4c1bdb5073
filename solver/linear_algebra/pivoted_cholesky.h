// Pivoted Cholesky factorisation of a small symmetric positive semidefinite matrix G = J M^-1 J^T,
// which is singular for redundant constraints.
//
//   S G S = L L^T on the r = rank pivot rows,   S = diag(G)^-1/2
// S makes rows of metres and radians comparable. The pivot is the row with the largest remaining
// diagonal (Higham 2002, section 10.3); rows with a remainder below `tolerance` depend on the pivot
// rows and get lambda = 0. S G S has a unit diagonal: the remainder of a dependent row is rounding
// of G, some eps times the condition of M^-1, rarely above 1e-13. An independent row of that size
// is an angle of 1e-6 between two constraints, close to a singular configuration. Cost m r^2; no
// allocation after the constructor.
#pragma once

#include <cstddef>
#include <vector>

namespace twinarm {

class PivotedCholesky {
 public:
  static constexpr double kDependent = 1e-12;

  explicit PivotedCholesky(std::size_t capacity);
  // Both triangles.
  double& operator()(std::size_t row, std::size_t column) { return A_[row * capacity_ + column]; }
  // size: diagonal of G before the elimination of other constraints, for S and the tolerance; null:
  // that of G.
  void factorise(std::size_t n, double tolerance = kDependent,
                 const double* size = nullptr) noexcept;
  // b := lambda with G lambda = b, for a b in the range of G; zero in dependent rows. y: work space
  // for rank numbers. T: a double or a vector of several right-hand sides.
  template <class T>
  void solve(T* b, T* y) const noexcept {
    const std::size_t r = chosen_.size();
    for (std::size_t k = 0; k < r; ++k) {
      const std::size_t p = chosen_[k];
      T sum = scale_[p] * b[p];
      for (std::size_t j = 0; j < k; ++j) sum = sum - L(p, j) * y[j];
      y[k] = (1 / L(p, k)) * sum;
    }
    for (std::size_t i = 0; i < n_; ++i) b[i] = T{};
    for (std::size_t k = r; k-- > 0;) {
      T sum = y[k];
      for (std::size_t j = k + 1; j < r; ++j) sum = sum - L(chosen_[j], k) * y[j];
      y[k] = (1 / L(chosen_[k], k)) * sum;
    }
    for (std::size_t k = 0; k < r; ++k) b[chosen_[k]] = scale_[chosen_[k]] * y[k];
  }
  std::size_t rank() const { return chosen_.size(); }

 private:
  double L(std::size_t row, std::size_t column) const { return L_[row * capacity_ + column]; }
  void add_column(std::size_t pivot) noexcept;

  std::size_t capacity_, n_ = 0;
  std::vector<double> A_, L_;         // L: rows as in A, columns in pivot order
  std::vector<double> scale_, left_;  // S; remaining diagonal
  std::vector<std::size_t> chosen_;
};

}  // namespace twinarm
