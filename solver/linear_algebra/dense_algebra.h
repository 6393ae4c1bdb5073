// Eigen's decompositions of dynamic-size matrices behind plain functions: for analyses, the start
// of a run, and tests. Compiled once, which saves 2 to 12 s per translation unit. Cost O(n^3); all
// allocate. Within steps use solver/linear_algebra/dense_spd.h.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace twinarm {

// M^-1 B, M symmetric, by L D L^T.
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& M, const Eigen::MatrixXd& B);
// A^-1, by LU with partial pivoting.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& A);

// Minimum-norm least-squares solution of A x = b, by a complete orthogonal decomposition; pivots
// below `threshold` times the largest count as zero (0: Eigen's default threshold).
Eigen::VectorXd min_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                             double threshold = 0);

// Rank of A (pivots below `threshold` times the largest count as zero), and the column order of a
// pivoted QR factorization.
struct PivotedColumns {
  Eigen::Index rank;
  std::vector<Eigen::Index> order;
};
PivotedColumns pivoted_columns(const Eigen::MatrixXd& A, double threshold);

// Of each unknown of A x = b: what part of a change of it can be balanced by the others, the
// squared length of its unit vector's projection on the null space of A; 0: determined, 1: free.
Eigen::VectorXd undetermined_part(const Eigen::MatrixXd& A, double threshold);

// A = U diag(values) V^T, A square; descending.
struct SingularValues {
  Eigen::VectorXd values;
  Eigen::MatrixXd V;
};
SingularValues singular_values(const Eigen::MatrixXd& A);

// A x = x lambda, in no particular order.
struct Eigensystem {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  // unit columns
};
Eigensystem eigensystem_of(const Eigen::MatrixXd& A);
Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& A);

// K x = M x lambda, both symmetric, M positive definite; ascending.
struct SymmetricEigensystem {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  // columns with x^T M x = 1
};
SymmetricEigensystem generalized_eigensystem(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);
Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);
// Of a symmetric matrix; ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& A);

}  // namespace twinarm
