#include "coupling/analysis/step_matrix.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "coupling/analysis/gains.h"
#include "coupling/analysis/joint_space_stiffness.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int kMaxPeriod = 100000;  // steps between common evaluations of held forces

// Step matrix of the state (e; h v; f_1 ..; e_1 ..). f: held forces; e_1 ..: for terms with
// difference velocities, e at the last evaluation, and if the difference is one frame older, that
// difference.
class StepMatrix {
 public:
  StepMatrix(const std::vector<CoupledTerm>& terms, double h, Index n) : n_(n) {
    const MatrixXd none = MatrixXd::Zero(n, n);
    MatrixXd alpha = none, beta = none, lead = none, inertia = MatrixXd::Identity(n, n);
    for (const CoupledTerm& term : terms) {
      if (term.law == StepLaw::god_object) {
        alpha += term.K;
        beta += term.K;
        continue;
      }
      const MatrixXd a = h * h * term.K, b = h * term.B;
      const bool printed = term.law == StepLaw::printed, pd = term.law == StepLaw::stable_pd;
      if (term.hold_steps > 0 || printed) {
        held_.push_back(
            {a, b, std::max(1, term.hold_steps), printed ? history_ + 1 : 0, term.older});
        history_ += printed + (printed && term.older);
        continue;
      }
      alpha += a;
      beta += b;
      if (pd || term.discretization != Discretization::explicit_) inertia += b;
      if (pd || term.discretization == Discretization::implicit) lead += h * h * term.K_zero;
      if (!pd && term.discretization == Discretization::implicit) inertia += h * h * term.K_zero;
    }
    const auto groups = static_cast<Index>(held_.size());
    const Index rows = n * (2 + groups + history_);
    one_ = MatrixXd::Identity(rows, rows);
    a_ = MatrixXd::Zero(n, rows);
    a_.leftCols(n * (2 + groups)) << -alpha, -(beta + lead),
        MatrixXd::Identity(n, n).replicate(1, groups);
    a_ = inverse_of(inertia) * a_;
  }

  // Matrix between two times at which all held forces are computed, and the number of steps.
  MatrixXd period(Integrator integrator, int& steps) const {
    steps = 1;
    for (const Held& held : held_) steps = std::min(std::lcm(steps, held.steps), kMaxPeriod);
    // This integrator evaluates forces at the new coordinates, between drift and kick.
    const bool drifts = integrator == Integrator::semi_implicit_xv;
    const MatrixXd e = one_.topRows(n_), v = one_.middleRows(n_, n_);
    const MatrixXd drift = drifts ? with(e + v, v) : one_;
    const MatrixXd step = drifts ? with(e, v + a_) : of(integrator);
    MatrixXd all = one_;
    for (int s = 0; s < steps; ++s) all = step * evaluated(s) * drift * all;
    return all;
  }

 private:
  struct Held {
    MatrixXd alpha, beta;
    int steps;
    Index history;  // index of the e_1 ..; 0: true rate
    bool older;     // uses the previous difference, stored behind it
  };

  MatrixXd with(const MatrixXd& e, const MatrixXd& v) const {
    MatrixXd y = one_;
    y.topRows(n_) = e;
    y.middleRows(n_, n_) = v;
    return y;
  }
  MatrixXd evaluated(int s) const {
    MatrixXd y = one_;
    for (std::size_t g = 0; g < held_.size(); ++g) {
      if (s % held_[g].steps != 0) continue;
      auto f = y.middleRows(n_ * (2 + static_cast<Index>(g)), n_);
      f.setZero();
      f.leftCols(n_) = -held_[g].alpha;
      if (held_[g].history == 0) {
        f.middleCols(n_, n_) = -held_[g].beta;
        continue;
      }
      const Index history = n_ * (1 + static_cast<Index>(held_.size()) + held_[g].history);
      const MatrixXd difference = one_.topRows(n_) - one_.middleRows(history, n_);
      f -= held_[g].beta / held_[g].steps *
           (held_[g].older ? MatrixXd(one_.middleRows(history + n_, n_)) : difference);
      if (held_[g].older) y.middleRows(history + n_, n_) = difference;
      y.middleRows(history, n_) = one_.topRows(n_);
    }
    return y;
  }
  // Integrators of solver/integration/integrator.h for a linear system.
  MatrixXd of(Integrator integrator) const {
    const MatrixXd e = one_.topRows(n_), v = one_.middleRows(n_, n_);
    MatrixXd rate = MatrixXd::Zero(one_.rows(), one_.cols());
    rate.topRows(n_) = v;
    rate.middleRows(n_, n_) = a_;
    switch (integrator) {
      case Integrator::semi_implicit:
        return with(e + v + a_, v + a_);
      case Integrator::verlet: {
        const MatrixXd half = v + a_ / 2, moved = e + half;
        return with(moved, half + a_ * with(moved, v + a_) / 2);
      }
      case Integrator::euler:
        return one_ + rate;
      case Integrator::midpoint:
      case Integrator::heun:
        return one_ + rate * (one_ + rate / 2);
      case Integrator::implicit_euler:
        return inverse_of(one_ - rate);
      case Integrator::implicit_midpoint:
      case Integrator::trapezoid:
        return inverse_of(one_ - rate / 2) * (one_ + rate / 2);
      case Integrator::semi_implicit_xv:  // in period()
      case Integrator::rk4:
      case Integrator::dopri5:
        break;
    }
    return one_ + rate * (one_ + rate / 2 * (one_ + rate / 3 * (one_ + rate / 4)));
  }

  Index n_;
  MatrixXd one_, a_;
  std::vector<Held> held_;
  Index history_ = 0;
};

struct Reduced {
  std::vector<CoupledTerm> terms;  // with M = 1
  Index n = 0;
  double rate = 0;  // maximum rate [1/s]
};

// Projection to the modes.
Reduced reduced(const MatrixXd& M, const std::vector<CoupledTerm>& terms) {
  MatrixXd K = MatrixXd::Zero(M.rows(), M.cols()), B = K;
  for (const CoupledTerm& term : terms) {
    K += term.K;
    B += term.B;
  }
  const SpringModes modes = spring_modes(M, K, B);
  Reduced found;
  found.n = modes.size();
  if (found.n == 0) return found;
  const auto by_modes = [&](const MatrixXd& A) {
    return MatrixXd(modes.shapes.transpose() * A * modes.shapes);
  };
  for (const CoupledTerm& term : terms)
    found.terms.push_back({by_modes(term.K), by_modes(term.K_zero), by_modes(term.B),
                           term.discretization, term.hold_steps, term.law, term.older});
  found.rate = modes.max_rate();
  return found;
}

}  // namespace

double growth_of_modes(const std::vector<CoupledTerm>& terms, Integrator integrator, double h) {
  int steps = 1;
  const MatrixXd all = StepMatrix(terms, h, terms.front().K.rows()).period(integrator, steps);
  return std::pow(eigenvalues_of(all).cwiseAbs().maxCoeff(), 1.0 / steps);
}

double spectral_radius(const MatrixXd& M, const std::vector<CoupledTerm>& terms,
                       Integrator integrator, double h) {
  check_step_size(h);
  const Reduced system = reduced(M, terms);
  return system.n == 0 ? 1 : growth_of_modes(system.terms, integrator, h);
}

double max_stable_step(const MatrixXd& M, const std::vector<CoupledTerm>& terms,
                       Integrator integrator) {
  constexpr double kRounding = 1e-9;
  const Reduced system = reduced(M, terms);
  if (system.n == 0 || integrator == Integrator::dopri5) return kNoLimit;
  return max_stable(
      [&](double h) { return growth_of_modes(system.terms, integrator, h) <= 1 + kRounding; },
      1e-4 / system.rate, 1e4 / system.rate);
}

}  // namespace twinarm
