#include "app/modes/linear_system.h"

#include "solver/dynamics/derivatives.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/model/mimic.h"

namespace twinarm {
namespace {

using Eigen::Index;

// Derivatives of the applied forces (f_ext; tau) at x along one velocity.
class ForceRates {
 public:
  ForceRates(const Model<double>& model, const State<double>& x, const AppliedForces& push)
      : model_(model), push_(model, x, push) {}

  Forces<double> along(std::size_t dof, bool of_velocity) {
    return extrapolated_rate(
        4e-2, [&](double s) { return difference(dof, of_velocity, s); },
        [&](const auto& a, double by_a, auto& b, double by_b) { combine(a, by_a, b, by_b); });
  }

 private:
  // b = by_a a + by_b b
  void combine(const Forces<double>& a, double by_a, Forces<double>& b, double by_b) const {
    for (std::size_t i = 0; i < model_.nv; ++i) b.tau[i] = by_a * a.tau[i] + by_b * b.tau[i];
    for (std::size_t i = 0; i < a.f_ext.size(); ++i)
      b.f_ext[i] = by_a * a.f_ext[i] + by_b * b.f_ext[i];
  }
  Forces<double> difference(std::size_t dof, bool of_velocity, double s) {
    Forces<double> after = push_.at(dof, of_velocity, s);
    combine(push_.at(dof, of_velocity, -s), -0.5 / s, after, 0.5 / s);
    return after;
  }

  const Model<double>& model_;
  NearbyForces push_;
};

// dq' = dqd - w x dq of spherical and free joints.
void add_turning(const Model<double>& model, const State<double>& x, Eigen::MatrixXd& W) {
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    if (facts_of(model.joint[i]).quaternion < 0 || model.dofs(i) == 0) continue;
    const double* w = x.qd.data() + model.iv[i];
    const Index at = signed_index(model.iv[i]);
    W.block<3, 3>(at, at) << 0, w[2], -w[1], -w[2], 0, w[0], w[1], -w[0], 0;
  }
}

// Time unit in which the entries of A have similar size.
double unit_of_time(const Eigen::MatrixXd& A) {
  const Index n = A.rows() / 2;
  const double stiff = A.bottomLeftCorner(n, n).lpNorm<Eigen::Infinity>();
  const double damp = std::max(A.bottomRightCorner(n, n).lpNorm<Eigen::Infinity>(),
                               A.topLeftCorner(n, n).lpNorm<Eigen::Infinity>());
  const double rate = std::max(std::sqrt(stiff), damp);
  return rate > 0 ? 1 / rate : 1;
}

Mode mode_of(std::complex<double> eigenvalue, const Eigen::VectorXcd& vector) {
  constexpr double kNothing = 1e-6;
  const Index n = vector.size() / 2;
  Eigen::VectorXcd shape = vector.head(n);
  if (shape.lpNorm<Eigen::Infinity>() < kNothing * vector.lpNorm<Eigen::Infinity>())
    shape = vector.tail(n);  // drift: the velocity gives the direction
  return scaled({eigenvalue, shape});
}

}  // namespace

LinearSystem linearise(const Model<double>& model, const State<double>& x,
                       const AppliedForces& push) {
  const Index nv = signed_index(model.nv);
  const Kinematics k = kinematics_at(model, x);
  Forces<double> forces(model);
  push(x, k, forces);
  const ForwardDynamicsDerivatives passes = forward_dynamics_derivatives(model, x, forces);
  Eigen::MatrixXd by_q = passes.dq, by_qd = passes.dqd, W = Eigen::MatrixXd::Zero(nv, nv);
  add_turning(model, x, W);

  Workspace<double> w(model);
  aba(model, x, forces, w);
  ForceRates rates(model, x, push);
  for (std::size_t dof = 0; dof < model.nv; ++dof)
    for (const bool of_velocity : {false, true}) {
      const Forces<double> rate = rates.along(dof, of_velocity);
      minv_times(model, rate.tau, rate.f_ext, w);
      (of_velocity ? by_qd : by_q).col(signed_index(dof)) +=
          Eigen::Map<const Eigen::VectorXd>(w.y.data(), nv);
    }

  // Without mimic joints: y of qd = G y, with M_y = G^T M G.
  const Eigen::MatrixXd M = mass_matrix(model, x);
  const Eigen::MatrixXd G = mimic_projection(model), M_y = G.transpose() * M * G;
  const Index n = G.cols();
  LinearSystem system{independent_dofs(model), Eigen::MatrixXd::Zero(2 * n, 2 * n),
                      Eigen::MatrixXd::Zero(2 * n, n)};
  if (n == 0) return system;
  system.A.topLeftCorner(n, n) = W(system.dofs, system.dofs);
  system.A.topRightCorner(n, n).setIdentity();
  system.A.bottomLeftCorner(n, n) = solve_symmetric(M_y, G.transpose() * M * by_q * G);
  system.A.bottomRightCorner(n, n) = solve_symmetric(M_y, G.transpose() * M * by_qd * G);
  system.B.bottomRows(n) = solve_symmetric(M_y, Eigen::MatrixXd::Identity(n, n));
  return system;
}

Mode scaled(Mode mode) {
  if (mode.shape.size() == 0) return mode;
  Index largest = 0;
  mode.shape.cwiseAbs().maxCoeff(&largest);
  const std::complex<double> scale = mode.shape[largest];
  if (std::abs(scale) > 0) mode.shape /= scale;
  return mode;
}

// The null space Z of A is deflated first: a drift (double eigenvalue 0, one eigenvector) would
// lose half of the digits. With its complement Q, A = (0 Z^T A Q; 0 Q^T A Q).
std::vector<Mode> modes_of(const Eigen::MatrixXd& given) {
  constexpr double kNull = 1e-11, kZero = 1e-9;
  std::vector<Mode> modes;
  const Index n = given.rows() / 2;
  if (n == 0) return modes;
  const double T = unit_of_time(given);
  Eigen::MatrixXd A = given;
  A.topLeftCorner(n, n) *= T;
  A.bottomRightCorner(n, n) *= T;
  A.bottomLeftCorner(n, n) *= T * T;

  const SingularValues sigma = singular_values(A);
  const Index rank = (sigma.values.array() > kNull * sigma.values[0]).count();
  const Eigen::MatrixXd Q = sigma.V.leftCols(rank), Z = sigma.V.rightCols(2 * n - rank);
  for (Index z = 0; z < Z.cols(); ++z)
    modes.push_back(mode_of(0, Z.col(z).cast<std::complex<double>>()));

  const Eigen::MatrixXd rest = Q.transpose() * A * Q, into = Z.transpose() * A * Q;
  const Eigensystem motion = eigensystem_of(rest);
  for (Index k = 0; k < rank; ++k) {
    std::complex<double> lambda = motion.values[k];
    if (lambda.imag() < 0) continue;
    if (std::abs(lambda) < kZero) lambda = 0;
    const Eigen::VectorXcd y = motion.vectors.col(k);
    Eigen::VectorXcd x = Q.cast<std::complex<double>>() * y;
    if (lambda != 0.0 && Z.cols() > 0)
      x += Z.cast<std::complex<double>>() * (into.cast<std::complex<double>>() * y) / lambda;
    modes.push_back(mode_of(lambda / T, x));
  }
  std::ranges::stable_sort(
      modes, [](const Mode& a, const Mode& b) { return a.frequency() < b.frequency(); });
  return modes;
}

}  // namespace twinarm
