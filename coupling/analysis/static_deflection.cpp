#include "coupling/analysis/static_deflection.h"

#include <cmath>
#include <limits>

#include "solver/dynamics/dynamics.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/support/diagnostics.h"

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

TargetRadius nearest_target_radius(const Model<double>& model, const State<double>& x,
                                   const Kinematics& D, const Kinematics& K, const Spring& spring,
                                   double h) {
  const Eigen::MatrixXd M = mass_matrix(model, x);
  const Vector3 p_D = D.position(spring.body, spring.p_L);
  const Vector3 p_K = K.position(spring.body, spring.p_L);
  TargetRadius nearest;
  for (int body = spring.body; body > 0; body = model.parent[static_cast<std::size_t>(body)]) {
    const auto i = static_cast<std::size_t>(body);
    if (model.joint[i] != JointType::revolute) continue;
    const auto dof = static_cast<Eigen::Index>(model.iv[i]);
    const Vector3 axis = D.R_WB[i].col(2);  // of a joint of one degree of freedom: z of its body
    const auto radius = [&](const Vector3& p) { return (p - D.X_WL[i].p).cross(axis).norm(); };
    TargetRadius here{body, radius(p_D), radius(p_K), 0};
    here.largest = largest_target_radius(M(dof, dof), here.r, spring.k, spring.b, h);
    if (nearest.body == 0 || here.ratio() > nearest.ratio()) nearest = here;
  }
  return nearest;
}

}  // namespace twinarm
