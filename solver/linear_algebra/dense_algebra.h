// Decompositions of matrices whose sizes are known at run time only, by Eigen: for analyses, starts
// of runs, oracles. Their text takes a compiler 2 to 12 s in every unit that uses it: behind these
// functions it is compiled once. Cost O(n^3); all allocate. (In a step:
// solver/linear_algebra/dense_spd.h.)
#pragma once

#include <Eigen/Core>
#include <vector>

namespace twinarm {

// M^-1 B, M symmetric, by L D L^T.
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& M, const Eigen::MatrixXd& B);
// A^-1 b, by LU with complete pivoting; one of the solutions where A is singular.
Eigen::VectorXd solve_pivoted(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
// A^-1, by LU with partial pivoting.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& A);

// The shortest x with the least |A x - b|, by a complete orthogonal decomposition; pivots below
// `threshold` times the largest count as zero (0: below the rounding errors of A's size).
Eigen::VectorXd min_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                             double threshold = 0);

// How many columns of A are independent (pivots below `threshold` times the largest count as zero),
// and all columns' numbers in the order in which a QR factorization takes them.
struct PivotedColumns {
  Eigen::Index rank;
  std::vector<Eigen::Index> order;
};
PivotedColumns pivoted_columns(const Eigen::MatrixXd& A, double threshold);

// A = U diag(values) V^T, A square. Descending.
struct SingularValues {
  Eigen::VectorXd values;
  Eigen::MatrixXd V;
};
SingularValues singular_values(const Eigen::MatrixXd& A);

// A x = x lambda. In any order.
struct Eigensystem {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;  // columns of length 1
};
Eigensystem eigensystem_of(const Eigen::MatrixXd& A);
Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& A);

// K x = M x lambda, both symmetric, M positive definite. Ascending.
struct SymmetricEigensystem {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  // columns with x^T M x = 1
};
SymmetricEigensystem generalized_eigensystem(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);
Eigen::VectorXd generalized_eigenvalues(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);
// Of a symmetric matrix. Ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& A);

}  // namespace twinarm
