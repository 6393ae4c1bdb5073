#include "coupling/analysis/static_deflection.h"

#include <cmath>
#include <limits>

#include "solver/linear_algebra/dense_algebra.h"
#include "solver/support/step_size.h"

namespace twinarm {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double largest_target_radius(double I, double r, double k, double b, double h) {
  check_step_size(h);
  if (k == 0 || r == 0) return std::numeric_limits<double>::infinity();
  return (4 * I + 2 * r * r * (h * h * k + h * b)) / (h * h * k * r);
}

VectorXd chain_sag(const MatrixXd& K, const VectorXd& G) {
  constexpr double kNothing = 1e-12;
  const double largest = K.cwiseAbs().maxCoeff();
  std::vector<Index> held;
  for (Index i = 0; i < K.rows(); ++i)
    if (K.row(i).cwiseAbs().maxCoeff() > kNothing * largest) held.push_back(i);
  VectorXd sag = VectorXd::Constant(G.size(), std::numeric_limits<double>::quiet_NaN());
  if (held.empty()) return sag;
  const VectorXd e = shortest_solution(K(held, held), G(held), kNothing);
  constexpr double kUnheld = 1e-6;  // a part of G that no spring can carry at this pose
  if ((K(held, held) * e - G(held)).norm() > kUnheld * G.norm()) return sag;
  for (std::size_t i = 0; i < held.size(); ++i) sag[held[i]] = e[static_cast<Index>(i)];
  return sag;
}

double series_stiffness(double k_c, double k_e) {
  if (std::isinf(k_c)) return k_e;
  if (std::isinf(k_e)) return k_c;
  return k_c + k_e > 0 ? k_c * k_e / (k_c + k_e) : 0;
}

}  // namespace twinarm
