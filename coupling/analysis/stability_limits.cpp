#include "coupling/analysis/stability_limits.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "coupling/analysis/joint_space_stiffness.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/support/step_size.h"

namespace twinarm {

using Eigen::Index;
using Eigen::MatrixXd;

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
    case Scheme::rk4:
      return "Runge-Kutta of order 4";
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
    case Scheme::rk4: {
      const std::complex<double> root = std::sqrt(std::complex<double>(beta * beta - 4 * alpha));
      const auto grows_by = [](std::complex<double> l) {
        return std::abs(1.0 + l * (1.0 + l / 2.0 * (1.0 + l / 3.0 * (1.0 + l / 4.0))));
      };
      return grows_by((root - beta) / 2.0) < 1 && grows_by((-root - beta) / 2.0) < 1;
    }
    case Scheme::implicit_damper:
      return alpha < 4 + 2 * beta;
    case Scheme::implicit:
      return true;
  }
  return false;
}

namespace {

// e, h v and what is remembered of a step before (its position, or its h v), as blocks of rows of
// the state before the step.
struct Blocks {
  Index n;
  Index count;
  MatrixXd of(Index block) const {
    MatrixXd rows = MatrixXd::Zero(n, n * count);
    rows.middleCols(block * n, n).setIdentity();
    return rows;
  }
};

MatrixXd stacked(const MatrixXd& e, const MatrixXd& v) {
  MatrixXd all(2 * e.rows(), e.cols());
  all << e, v;
  return all;
}
MatrixXd stacked(const MatrixXd& e, const MatrixXd& v, const MatrixXd& remembered) {
  MatrixXd all(3 * e.rows(), e.cols());
  all << e, v, remembered;
  return all;
}

MatrixXd runge_kutta_matrix(const MatrixXd& alpha, const MatrixXd& beta) {
  const Blocks state{alpha.rows(), 2};
  const MatrixXd l = stacked(state.of(1), -alpha * state.of(0) - beta * state.of(1));
  const MatrixXd one = MatrixXd::Identity(l.rows(), l.cols());
  return one + l * (one + l / 2 * (one + l / 3 * (one + l / 4)));
}

// With M = 1: alpha = h^2 K, beta = h B.
MatrixXd step_matrix(const MatrixXd& alpha, const MatrixXd& beta, Scheme scheme) {
  const bool remembers = scheme == Scheme::euler_difference || scheme == Scheme::hold_difference ||
                         scheme == Scheme::semi_implicit_older;
  const Blocks state{alpha.rows(), remembers ? 3 : 2};
  const MatrixXd e = state.of(0), v = state.of(1), one = MatrixXd::Identity(state.n, state.n);
  const auto pull = [&](const MatrixXd& seen) -> MatrixXd { return -alpha * e - beta * seen; };
  switch (scheme) {
    case Scheme::euler:
      return stacked(e + v, v + pull(v));
    case Scheme::semi_implicit:
    case Scheme::semi_implicit_difference:
      return stacked(e + v + pull(v), v + pull(v));
    case Scheme::euler_difference: {
      const MatrixXd a = pull(e - state.of(2));
      return stacked(e + v, v + a, e);
    }
    case Scheme::semi_implicit_older: {
      const MatrixXd a = pull(state.of(2));
      return stacked(e + v + a, v + a, v);
    }
    case Scheme::hold:
      return stacked(e + v + pull(v) / 2, v + pull(v));
    case Scheme::hold_difference: {
      const MatrixXd a = pull(e - state.of(2));
      return stacked(e + v + a / 2, v + a, e);
    }
    case Scheme::rk4:
      return runge_kutta_matrix(alpha, beta);
    case Scheme::implicit_damper: {
      const MatrixXd a = inverse_of(one + beta) * pull(v);
      return stacked(e + v + a, v + a);
    }
    case Scheme::implicit:
      break;
  }
  const MatrixXd a = inverse_of(one + beta + alpha) * (pull(v) - alpha * v);
  return stacked(e + v + a, v + a);
}

bool contracts(const MatrixXd& alpha, const MatrixXd& beta, Scheme scheme) {
  constexpr double kRounding = 1e-9;
  return eigenvalues_of(step_matrix(alpha, beta, scheme)).cwiseAbs().maxCoeff() <= 1 + kRounding;
}

// The rate [1/s] of what is fastest.
double fastest_rate(const SpringModes& modes) {
  return std::max(std::sqrt(modes.squares.cwiseAbs().maxCoeff()),
                  modes.damping.cwiseAbs().maxCoeff());
}

}  // namespace

double largest_stable_step(const MatrixXd& M, const MatrixXd& K, const MatrixXd& B, Scheme scheme) {
  const SpringModes modes = spring_modes(M, K, B);
  if (modes.size() == 0) return kNoLimit;
  const MatrixXd squares = modes.squares.asDiagonal();
  const double rate = fastest_rate(modes);
  return largest_stable(
      [&](double h) { return contracts(h * h * squares, h * modes.damping, scheme); }, 1e-4 / rate,
      1e4 / rate);
}

double largest_stiffness_factor(const MatrixXd& M, const MatrixXd& K, const MatrixXd& B,
                                Scheme scheme, double h, Keep keep) {
  check_step_size(h);
  const SpringModes modes = spring_modes(M, K, B);
  if (modes.size() == 0) return kNoLimit;
  const MatrixXd squares = modes.squares.asDiagonal();
  const auto stable = [&](double factor) {
    const double of_b = keep == Keep::damping_ratio ? std::sqrt(factor) : factor;
    return contracts(factor * h * h * squares, of_b * h * modes.damping, scheme);
  };
  const double product = std::max(fastest_rate(modes) * h, 1e-12);
  return largest_stable(stable, 1e-6 / (product * product), 1e8);
}

double largest_omega_h(Scheme scheme, double zeta) {
  const auto stable = [&](double wh) {
    return contracts(MatrixXd::Constant(1, 1, wh * wh), MatrixXd::Constant(1, 1, 2 * zeta * wh),
                     scheme);
  };
  return largest_stable(stable, 1e-4, 1e4);
}

}  // namespace twinarm
