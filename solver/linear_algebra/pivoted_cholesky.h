// Pivoted Cholesky factors of a small symmetric positive SEMIdefinite matrix: of G = J M^-1 J^T,
// whose rows depend on one another where loops are redundant.
//
//   S G S = L L^T on the rank r rows that are chosen,   S = diag(G)^-1/2
// S makes rows of metres, radians and of any size alike. In each round the row of largest
// remaining diagonal is taken (Higham 2002, section 10.3); what is left below `tolerance` depends
// on the rows taken, and its lambda is zero. S G S has a diagonal of ones, so what remains of a
// dependent row is the rounding of G: some eps times the condition of M^-1, seldom above 1e-13. A
// true row of that size is an angle of 1e-6 between two constraints: so near to a singular place,
// that the direction is not known any more. Cost m r^2; no allocation after the constructor.
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
  void factorise(std::size_t n, double tolerance = kDependent) noexcept;
  // b to lambda with G lambda = b, where b is such that there is one; zero in dependent rows.
  void solve(double* b) const noexcept;
  std::size_t rank() const { return chosen_.size(); }

 private:
  double L(std::size_t row, std::size_t column) const { return L_[row * capacity_ + column]; }
  void take(std::size_t pivot) noexcept;

  std::size_t capacity_, n_ = 0;
  std::vector<double> A_, L_;         // L by rows of A, columns in the order of choice
  std::vector<double> scale_, left_;  // S, and the diagonal that remains
  std::vector<std::size_t> chosen_;
  mutable std::vector<double> y_;
};

}  // namespace twinarm
