// Envelope (skyline) LU of a sparse matrix with symmetric pattern: each row and column is stored
// from its first nonzero entry to the diagonal; elimination without pivoting has no fill-in outside
// (Jennings 1966). Cost about rows * width^2 multiplications, half for a symmetric matrix.
#pragma once

#include <cstddef>
#include <vector>

namespace twinarm {

class EnvelopeLu {
 public:
  void clear() { first_.clear(), begin_.clear(), lower_.clear(), upper_.clear(); }
  // Appends a row with its first entry in column `first`, and the column with its first entry in
  // row `first`; all entries 0.
  void add_row(std::size_t first);
  std::size_t rows() const { return first_.size(); }
  void set_zero();
  // Lower triangle with diagonal: first(row) <= column <= row.
  double* row(std::size_t row, std::size_t column) {
    return lower_.data() + begin_[row] + column - first_[row];
  }
  // Strictly upper triangle: first(column) <= row < column.
  double* column(std::size_t column, std::size_t row) {
    return upper_.data() + begin_[column] + row - first_[column];
  }
  // False: a pivot is zero or not a number. Symmetric: the upper triangle is not read.
  bool factorise(bool symmetric);
  void solve(double* b) const;  // b := A^-1 b
  int determinant_sign() const;

 private:
  std::vector<std::size_t> first_, begin_;
  std::vector<double> lower_, upper_;  // rows of L, each ending with 1 / u_rr; columns of U
};

}  // namespace twinarm
