// Coulomb friction by enumeration: each of n <= 5 dofs sticks or slides one way.
#pragma once

#include <Eigen/LU>
#include <optional>

namespace twinarm::testing {

// A^-1 b, by LU with complete pivoting; for singular A one of the solutions.
inline Eigen::VectorXd solve_pivoted(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  if (A.size() == 0) return Eigen::VectorXd::Zero(A.cols());
  return A.fullPivLu().solve(b);
}

// f in [low, high] with v' = a + B f, v' > 0 only at low, v' < 0 only at high; each of the 3^n sets
// is solved by a dense factorisation and checked.
inline std::optional<Eigen::VectorXd> friction_by_enumeration(const Eigen::MatrixXd& B,
                                                              const Eigen::VectorXd& a,
                                                              const Eigen::VectorXd& low,
                                                              const Eigen::VectorXd& high) {
  const Eigen::Index n = a.size();
  Eigen::Index cases = 1;
  for (Eigen::Index i = 0; i < n; ++i) cases *= 3;
  for (Eigen::Index c = 0; c < cases; ++c) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n);  // f = bound, or v' = 0
    Eigen::VectorXd b(n);
    for (Eigen::Index i = 0, digits = c; i < n; ++i, digits /= 3) {
      if (digits % 3 == 0) A.row(i) = B.row(i);
      b[i] = digits % 3 == 0 ? -a[i] : digits % 3 == 1 ? low[i] : high[i];
    }
    const Eigen::VectorXd f = solve_pivoted(A, b), v = a + B * f;
    bool good = true;
    for (Eigen::Index i = 0, digits = c; i < n; ++i, digits /= 3)
      good = good && (digits % 3 == 0   ? f[i] >= low[i] - 1e-12 && f[i] <= high[i] + 1e-12
                      : digits % 3 == 1 ? v[i] >= -1e-12
                                        : v[i] <= 1e-12);
    if (good) return f;
  }
  return std::nullopt;
}

}  // namespace twinarm::testing
