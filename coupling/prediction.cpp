#include "coupling/prediction.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "solver/dense_algebra.h"
#include "solver/dynamics.h"

namespace twinarm {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const char* name_of(Scheme scheme) {
  switch (scheme) {
    case Scheme::euler:
      return "explicit Euler";
    case Scheme::semi_implicit:
      return "semi-implicit Euler";
    case Scheme::euler_difference:
      return "explicit Euler, backward difference";
    case Scheme::semi_implicit_difference:
      return "semi-implicit Euler, backward difference";
    case Scheme::semi_implicit_older:
      return "semi-implicit Euler, difference one frame older";
    case Scheme::hold:
      return "zero-order hold, true velocity";
    case Scheme::hold_difference:
      return "zero-order hold, backward difference";
    case Scheme::implicit_damper:
      return "semi-implicit Euler, damper implicit";
    case Scheme::implicit:
      return "spring and damper implicit";
  }
  return "";
}

bool is_stable(Scheme scheme, double alpha, double beta) {
  switch (scheme) {
    case Scheme::euler:
      return alpha < beta && beta < 2 + alpha / 2;
    case Scheme::semi_implicit:
    case Scheme::semi_implicit_difference:
      return alpha < 4 - 2 * beta;
    case Scheme::euler_difference:
      return beta < 1 && alpha < beta * (1 - beta);
    case Scheme::semi_implicit_older:
      return beta < 1 && alpha < 1 - beta;
    case Scheme::hold:
      return alpha < 2 * beta && beta < 2;
    case Scheme::hold_difference:
      return beta < 2 && alpha < 2 * beta * (2 - beta) / (2 + beta);
    case Scheme::implicit_damper:
      return alpha < 4 + 2 * beta;
    case Scheme::implicit:
      return true;
  }
  return false;
}

VectorXd squared_frequencies(const MatrixXd& M, const MatrixXd& K) {
  return generalized_eigenvalues(K, M);
}

namespace {

// [e'; v'] = A [e; v] for one step of size h.
MatrixXd step_matrix(const MatrixXd& M, const MatrixXd& K, const MatrixXd& B, Scheme scheme,
                     double h) {
  const Eigen::Index n = M.rows();
  MatrixXd felt = M;  // inertia that the step feels
  if (scheme == Scheme::implicit_damper || scheme == Scheme::implicit) felt += h * B;
  if (scheme == Scheme::implicit) felt += h * h * K;
  const MatrixXd inverse = Cholesky(felt).inverse();
  const MatrixXd spring = scheme == Scheme::implicit ? MatrixXd(B + h * K) : B;
  MatrixXd A(2 * n, 2 * n);
  A.bottomLeftCorner(n, n) = -h * inverse * K;
  A.bottomRightCorner(n, n) = MatrixXd::Identity(n, n) - h * inverse * spring;
  if (scheme == Scheme::euler) {
    A.topLeftCorner(n, n) = MatrixXd::Identity(n, n);
    A.topRightCorner(n, n) = h * MatrixXd::Identity(n, n);
  } else {
    A.topLeftCorner(n, n) = MatrixXd::Identity(n, n) + h * A.bottomLeftCorner(n, n);
    A.topRightCorner(n, n) = h * A.bottomRightCorner(n, n);
  }
  return A;
}

bool contracts(const MatrixXd& M, const MatrixXd& K, const MatrixXd& B, Scheme scheme, double h) {
  const MatrixXd A = step_matrix(M, K, B, scheme, h);
  return eigenvalues_of(A).cwiseAbs().maxCoeff() <= 1 + 1e-9;
}

}  // namespace

double largest_stable_step(const MatrixXd& M, const MatrixXd& K, const MatrixXd& B, Scheme scheme) {
  if (scheme != Scheme::euler && scheme != Scheme::semi_implicit &&
      scheme != Scheme::semi_implicit_difference && scheme != Scheme::implicit_damper &&
      scheme != Scheme::implicit)
    throw std::logic_error("largest_stable_step: the scheme has memory");
  double low = 1e-7, high = 10;
  if (contracts(M, K, B, scheme, high)) return std::numeric_limits<double>::infinity();
  if (!contracts(M, K, B, scheme, low)) return 0;
  while (high / low > 1 + 1e-9) {
    const double middle = std::sqrt(low * high);
    (contracts(M, K, B, scheme, middle) ? low : high) = middle;
  }
  return low;
}

VectorXd peak_after_jump(const MatrixXd& M, const MatrixXd& K, const MatrixXd& B, const VectorXd& V,
                         double time) {
  const Cholesky factors(M);
  const double stiffest = std::sqrt(squared_frequencies(M, K).maxCoeff());
  const double most_damped = squared_frequencies(M, B).maxCoeff();
  const double dt = std::min(time / 100, 0.02 / std::max(stiffest, most_damped));
  VectorXd e = VectorXd::Zero(V.size()), v = V, peak = e;
  const auto a = [&](const VectorXd& x, const VectorXd& xd) {
    return VectorXd(-factors.solve(K * x + B * xd));
  };
  for (double t = 0; t < time; t += dt) {  // classical Runge-Kutta
    const VectorXd a1 = a(e, v);
    const VectorXd v2 = v + dt / 2 * a1, a2 = a(e + dt / 2 * v, v2);
    const VectorXd v3 = v + dt / 2 * a2, a3 = a(e + dt / 2 * v2, v3);
    const VectorXd v4 = v + dt * a3, a4 = a(e + dt * v3, v4);
    e += dt / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    peak = peak.cwiseMax(e.cwiseAbs());
  }
  return peak;
}

double peak_after_jump(double V, double omega, double zeta) {
  if (std::abs(zeta - 1) < 1e-9) return V / omega / std::exp(1.0);
  if (zeta < 1) return V / omega * std::exp(-zeta * std::acos(zeta) / std::sqrt(1 - zeta * zeta));
  return V / omega * std::exp(-zeta * std::acosh(zeta) / std::sqrt(zeta * zeta - 1));
}

double largest_target_radius(double I, double r, double k, double b, double h) {
  if (k == 0 || r == 0) return std::numeric_limits<double>::infinity();
  return (4 * I + 2 * r * r * (h * h * k + h * b)) / (h * h * k * r);
}

MatrixXd mass_matrix(const Model<double>& model, const State<double>& x) {
  Workspace<double> w(model);
  crba(model, x, w);
  const auto n = static_cast<Eigen::Index>(model.nv);
  return Eigen::Map<const MatrixXd>(w.M.data(), n, n);  // symmetric
}

}  // namespace twinarm
