#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cassert>

#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Eigen's decompositions do not support empty matrices.
MatrixXd solve_symmetric(const MatrixXd& M, const MatrixXd& B) {
  if (M.size() == 0 || B.size() == 0) return MatrixXd::Zero(M.rows(), B.cols());
  return M.ldlt().solve(B);
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

VectorXd undetermined_part(const MatrixXd& A, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(A.rows() > 0 ? A.transpose() : MatrixXd(A.cols(), 1));
  qr.setThreshold(threshold);
  const MatrixXd Q = qr.householderQ() * MatrixXd::Identity(A.cols(), qr.rank());
  return VectorXd::Ones(A.cols()) - Q.rowwise().squaredNorm();
}

SingularValues singular_values(const MatrixXd& A) {
  assert(A.rows() == A.cols());  // NoQRPreconditioner requires a square matrix
  const Eigen::JacobiSVD<MatrixXd, Eigen::NoQRPreconditioner> svd(A, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

Eigensystem eigensystem_of(const MatrixXd& A) {
  const Eigen::EigenSolver<MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXcd eigenvalues_of(const MatrixXd& A) {
  return Eigen::EigenSolver<MatrixXd>(A, false).eigenvalues();
}

SymmetricEigensystem generalized_eigensystem(const MatrixXd& K, const MatrixXd& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(K, M);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd generalized_eigenvalues(const MatrixXd& K, const MatrixXd& M) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(K, M, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

Eigen::VectorXd symmetric_eigenvalues(const MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace twinarm
