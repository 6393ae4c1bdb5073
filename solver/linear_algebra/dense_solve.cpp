#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cassert>

#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of no rows or columns Eigen's decompositions take entries that are not there.
MatrixXd solve_symmetric(const MatrixXd& M, const MatrixXd& B) {
  if (M.size() == 0 || B.size() == 0) return MatrixXd::Zero(M.rows(), B.cols());
  return M.ldlt().solve(B);
}

VectorXd solve_pivoted(const MatrixXd& A, const VectorXd& b) {
  if (A.size() == 0) return VectorXd::Zero(A.cols());
  return A.fullPivLu().solve(b);
}

MatrixXd inverse_of(const MatrixXd& A) {
  return A.inverse();
}

VectorXd min_solution(const MatrixXd& A, const VectorXd& b, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver(A.rows(), A.cols());
  if (threshold > 0) solver.setThreshold(threshold);
  return solver.compute(A).solve(b);
}

PivotedColumns pivoted_columns(const MatrixXd& A, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(A);
  qr.setThreshold(threshold);
  const auto& order = qr.colsPermutation().indices();
  return {qr.rank(), {order.begin(), order.end()}};
}

SingularValues singular_values(const MatrixXd& A) {
  assert(A.rows() == A.cols());  // others need a QR first, in two more kinds
  const Eigen::JacobiSVD<MatrixXd, Eigen::NoQRPreconditioner> svd(A, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace twinarm
