// L U of a sparse matrix whose pattern is symmetric, stored from the first entry of a row (and of a
// column) that is not zero to the diagonal: elimination without pivoting fills nothing outside
// (Jennings 1966). No allocation once warm. Cost: about rows * width^2 multiplications, half of
// that for a symmetric matrix.
#pragma once

#include <cstddef>
#include <vector>

namespace twinarm {

class EnvelopeLu {
 public:
  void clear() { first_.clear(), begin_.clear(), lower_.clear(), upper_.clear(); }
  // The next row, whose first entry is in column `first`, like that of the column above the
  // diagonal; all entries 0.
  void add_row(std::size_t first);
  std::size_t rows() const { return first_.size(); }
  void set_zero();
  // Of the part below the diagonal, and the diagonal: first(row) <= column <= row.
  double* row(std::size_t row, std::size_t column) {
    return lower_.data() + begin_[row] + column - first_[row];
  }
  // Of the part above the diagonal: first(column) <= row < column.
  double* column(std::size_t column, std::size_t row) {
    return upper_.data() + begin_[column] + row - first_[column];
  }
  // A pivot that is zero gives numbers that are not finite. Symmetric: what is above is not read.
  void factorise(bool symmetric);
  void solve(double* b) const;  // b to A^-1 b
  int determinant_sign() const;

 private:
  std::vector<std::size_t> first_, begin_;
  std::vector<double> lower_, upper_;  // L by rows, 1 / u_rr at the end of each; U by columns
};

}  // namespace twinarm
