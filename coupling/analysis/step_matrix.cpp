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

constexpr int kLongestPeriod = 100000;  // of steps between evaluations, where several are held

// Rows of the state (e; h v; f_1 ..; e_1 ..) that a step leaves, from the state before it. f: the
// held forces; e_1 ..: of those that see differences, e at their last evaluation, and where they
// see an older one that difference.
class PartsStep {
 public:
  PartsStep(const std::vector<CoupledTerm>& parts, double h, Index n) : n_(n) {
    const MatrixXd none = MatrixXd::Zero(n, n);
    MatrixXd alpha = none, beta = none, ahead = none, felt = MatrixXd::Identity(n, n);
    for (const CoupledTerm& part : parts) {
      if (part.law == StepLaw::god_object) {
        alpha += part.K;
        beta += part.K;
        continue;
      }
      const MatrixXd a = h * h * part.K, b = h * part.B;
      const bool printed = part.law == StepLaw::printed, pd = part.law == StepLaw::stable_pd;
      if (part.hold_steps > 0 || printed) {
        held_.push_back({a, b, std::max(1, part.hold_steps), printed ? pasts_ + 1 : 0, part.older});
        pasts_ += printed + (printed && part.older);
        continue;
      }
      alpha += a;
      beta += b;
      if (pd || part.treatment != Discretization::explicit_) felt += b;
      if (pd || part.treatment == Discretization::implicit) ahead += h * h * part.K_zero;
      if (!pd && part.treatment == Discretization::implicit) felt += h * h * part.K_zero;
    }
    const auto groups = static_cast<Index>(held_.size());
    const Index rows = n * (2 + groups + pasts_);
    one_ = MatrixXd::Identity(rows, rows);
    a_ = MatrixXd::Zero(n, rows);
    a_.leftCols(n * (2 + groups)) << -alpha, -(beta + ahead),
        MatrixXd::Identity(n, n).replicate(1, groups);
    a_ = inverse_of(felt) * a_;
  }

  // From one time at which all held forces are computed to the next, and how many steps that is.
  MatrixXd period(Integrator integrator, int& steps) const {
    steps = 1;
    for (const Held& held : held_) steps = std::min(std::lcm(steps, held.steps), kLongestPeriod);
    // Its sources act at the new coordinates: forces are computed between the drift and the kick.
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
    Index past;  // which of the e_1 ..; 0: it sees the true rate
    bool older;  // it sees the difference that stands behind it
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
      if (held_[g].past == 0) {
        f.middleCols(n_, n_) = -held_[g].beta;
        continue;
      }
      const Index past = n_ * (1 + static_cast<Index>(held_.size()) + held_[g].past);
      const MatrixXd difference = one_.topRows(n_) - one_.middleRows(past, n_);
      f -= held_[g].beta / held_[g].steps *
           (held_[g].older ? MatrixXd(one_.middleRows(past + n_, n_)) : difference);
      if (held_[g].older) y.middleRows(past + n_, n_) = difference;
      y.middleRows(past, n_) = one_.topRows(n_);
    }
    return y;
  }
  // The formulas of solver/integration/integrator.h, of a linear system.
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
  Index pasts_ = 0;
};

struct Reduced {
  std::vector<CoupledTerm> parts;  // with M = 1
  Index n = 0;
  double rate = 0;  // of what is fastest [1/s]
};

// To the directions that any part holds.
Reduced reduced(const MatrixXd& M, const std::vector<CoupledTerm>& parts) {
  MatrixXd K = MatrixXd::Zero(M.rows(), M.cols()), B = K;
  for (const CoupledTerm& part : parts) {
    K += part.K;
    B += part.B;
  }
  const SpringModes modes = spring_modes(M, K, B);
  Reduced found;
  found.n = modes.size();
  if (found.n == 0) return found;
  const auto by_modes = [&](const MatrixXd& A) {
    return MatrixXd(modes.shapes.transpose() * A * modes.shapes);
  };
  for (const CoupledTerm& part : parts)
    found.parts.push_back({by_modes(part.K), by_modes(part.K_zero), by_modes(part.B),
                           part.treatment, part.hold_steps, part.law, part.older});
  found.rate = modes.fastest_rate();
  return found;
}

}  // namespace

double growth_of_modes(const std::vector<CoupledTerm>& parts, Integrator integrator, double h) {
  int steps = 1;
  const MatrixXd all = PartsStep(parts, h, parts.front().K.rows()).period(integrator, steps);
  return std::pow(eigenvalues_of(all).cwiseAbs().maxCoeff(), 1.0 / steps);
}

double spectral_radius(const MatrixXd& M, const std::vector<CoupledTerm>& parts,
                       Integrator integrator, double h) {
  check_step_size(h);
  const Reduced system = reduced(M, parts);
  return system.n == 0 ? 1 : growth_of_modes(system.parts, integrator, h);
}

double max_stable_step(const MatrixXd& M, const std::vector<CoupledTerm>& parts,
                       Integrator integrator) {
  constexpr double kRounding = 1e-9;
  const Reduced system = reduced(M, parts);
  if (system.n == 0 || integrator == Integrator::dopri5) return kNoLimit;
  return max_stable(
      [&](double h) { return growth_of_modes(system.parts, integrator, h) <= 1 + kRounding; },
      1e-4 / system.rate, 1e4 / system.rate);
}

}  // namespace twinarm
