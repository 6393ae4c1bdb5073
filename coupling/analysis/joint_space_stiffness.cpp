#include "coupling/analysis/joint_space_stiffness.h"

#include <array>
#include <limits>

#include "solver/linear_algebra/dense_algebra.h"
#include "solver/model/configuration.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Joint forces of applied forces: difference of two inverse dynamics at qdd = 0, which give
// C - J^T f_ext. O(n).
VectorXd generalised_force(const Model<double>& model, const State<double>& x,
                           const Forces<double>& forces) {
  Workspace<double> w(model);
  const auto n = static_cast<Index>(model.nv);
  const std::vector<double> zero(model.nv, 0.0);
  rnea(model, x, zero, std::vector<Force<double>>(model.parent.size()), w);
  VectorXd tau = Eigen::Map<const VectorXd>(w.tau.data(), n);
  rnea(model, x, zero, forces.f_ext, w);
  tau -= Eigen::Map<const VectorXd>(w.tau.data(), n);
  return tau + Eigen::Map<const VectorXd>(forces.tau.data(), n);
}

}  // namespace

double max_target_radius(double I, double r, double k, double b, double h) {
  check_step_size(h);
  if (k == 0 || r == 0) return std::numeric_limits<double>::infinity();
  return (4 * I + 2 * r * r * (h * h * k + h * b)) / (h * h * k * r);
}

VectorXd chain_sag(const MatrixXd& K, const VectorXd& G) {
  constexpr double kZero = 1e-12;
  const double max_K = K.cwiseAbs().maxCoeff();
  std::vector<Index> held;
  for (Index i = 0; i < K.rows(); ++i)
    if (K.row(i).cwiseAbs().maxCoeff() > kZero * max_K) held.push_back(i);
  VectorXd sag = VectorXd::Constant(G.size(), std::numeric_limits<double>::quiet_NaN());
  if (held.empty()) return sag;
  const VectorXd e = min_solution(K(held, held), G(held), kZero);
  constexpr double kUnheld = 1e-6;  // relative part of G that no spring can balance
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
    here.largest = max_target_radius(M(dof, dof), here.r, spring.k, spring.b, h);
    if (nearest.body == 0 || here.ratio() > nearest.ratio()) nearest = here;
  }
  return nearest;
}

Forces<double> NearbyForces::at(std::size_t dof, bool of_velocity, double s) {
  moved_ = x_;
  if (of_velocity) {
    moved_.qd[dof] += s;
  } else {
    std::vector<double> increment(model_.nv);
    increment[dof] = s;
    integrate_coordinates(model_, x_.q, increment, moved_.q);
  }
  forward_kinematics(model_, moved_, k_);
  Forces<double> forces(model_);
  applied_(moved_, k_, forces);
  return forces;
}

MatrixXd tangent_stiffness(const Model<double>& model, const State<double>& x,
                           const AppliedForces& applied, std::size_t count) {
  const auto n = static_cast<Index>(model.nv);
  MatrixXd K = MatrixXd::Zero(n, n);
  NearbyForces nearby(model, x, applied);
  for (std::size_t dof = 0; dof < count; ++dof) {
    const auto tau = [&](double s) -> VectorXd {
      const Forces<double> forces = nearby.at(dof, false, s);
      return generalised_force(model, nearby.state(), forces);
    };
    const auto difference = [&](double s) -> VectorXd { return (tau(-s) - tau(s)) / (2 * s); };
    // Steps s, s/2, s/4, extrapolated to order 6.
    std::array<VectorXd, 3> rate{difference(4e-2), difference(2e-2), difference(1e-2)};
    for (std::size_t i = 0; i < 2; ++i) rate[i] = (4 * rate[i + 1] - rate[i]) / 3;
    K.col(static_cast<Index>(dof)) = (16 * rate[1] - rate[0]) / 15;
  }
  return K;
}

VectorXd squared_frequencies(const MatrixXd& M, const MatrixXd& K) {
  return generalized_eigenvalues(K, M);
}

// Keeps the modes with non-zero stiffness or damping.
SpringModes spring_modes(const MatrixXd& M, const MatrixXd& K, const MatrixXd& B) {
  constexpr double kZero = 1e-10;
  if (M.rows() == 0) return {};
  const SymmetricEigensystem all = generalized_eigensystem((K + K.transpose()) / 2, M);
  const SymmetricEigensystem damped = generalized_eigensystem((B + B.transpose()) / 2, M);
  const double max_square = all.values.cwiseAbs().maxCoeff();
  const double max_damping = damped.values.cwiseAbs().maxCoeff();
  std::vector<Index> kept;
  for (Index i = 0; i < all.values.size(); ++i) {
    const double b = all.vectors.col(i).dot(B * all.vectors.col(i));
    if ((max_square > 0 && std::abs(all.values[i]) > kZero * max_square) ||
        (max_damping > 0 && std::abs(b) > kZero * max_damping))
      kept.push_back(i);
  }
  SpringModes modes{VectorXd(kept.size()), MatrixXd(M.rows(), kept.size()), {}};
  for (std::size_t c = 0; c < kept.size(); ++c) {
    const auto column = static_cast<Index>(c);
    const double square = all.values[kept[c]];
    modes.omega_squared[column] = std::abs(square) > kZero * max_square ? square : 0;
    modes.shapes.col(column) = all.vectors.col(kept[c]);
  }
  modes.damping = modes.shapes.transpose() * B * modes.shapes;
  return modes;
}

}  // namespace twinarm
