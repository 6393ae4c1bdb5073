#include "solver/loops/loop_projection.h"

#include <algorithm>
#include <cmath>

#include "solver/model/configuration.h"
#include "solver/model/mimic.h"

namespace twinarm {
namespace {

constexpr int kMaxProjections = 20;
// Relative to 1 m or rad and to the maximum velocity: tolerance, and the level at which stalled
// iterations count as converged. Both are small because near a singular configuration large
// velocity errors give a small g'.
constexpr double kProjectionRounding = 5e-16, kStallLevel = 2e-14;

double largest(const Eigen::VectorXd& v) {
  return v.size() == 0 ? 0 : v.lpNorm<Eigen::Infinity>();
}

void add(const std::vector<double>& delta, double s, std::vector<double>& sum) {
  for (std::size_t d = 0; d < sum.size(); ++d) sum[d] += s * delta[d];
}

}  // namespace

void LoopProjection::start(const ConstraintForceSolver& prepared,
                           const std::vector<std::size_t>& held, const State<double>& x,
                           const Kinematics& k, Workspace<double>& w) noexcept {
  forces_.copy_factors(prepared);
  if (held.empty()) return;
  forces_.loops().evaluate(x, k);
  forces_.prepare(w, held);
}

struct LoopProjection::At {
  const std::vector<std::size_t>& held;
  State<double>& x;
  Kinematics& k;
  Workspace<double>& w;
};

// norm(): error to be reduced. correct(): one correction. revert(): undoes it.
template <class Norm, class Correct, class Revert>
void LoopProjection::iterate(const At& at, double rounding, Norm&& norm, Correct&& correct,
                             Revert&& revert) {
  const auto evaluate = [&] {
    forward_kinematics(*model_, at.x, at.k);
    forces_.loops().evaluate(at.x, at.k);
  };
  double error = norm();
  bool recomputed = false;
  for (int n = 0; n < kMaxProjections && error > rounding; ++n) {
    correct();
    evaluate();
    const double after = norm();
    if (after < 0.5 * error) {
      error = after;
      continue;
    }
    const bool stalls = error <= kStallLevel / kProjectionRounding * rounding;
    if (stalls && after <= error) return;
    revert();
    evaluate();
    if (recomputed || stalls) return;
    // An error of `error` rad in the rows is error^2 in G.
    forces_.prepare(at.w, at.held, std::max(PivotedCholesky::kDependent, error * error));
    recomputed = true;
  }
}

double LoopProjection::operator()(const std::vector<std::size_t>& held, State<double>& x,
                                  Kinematics& k, Workspace<double>& w) noexcept {
  LoopClosures& loops = forces_.loops();
  loops.evaluate(x, k);
  for (std::vector<double>* sum : {&correction_q_, &correction_qd_, &lambda_q_, &lambda_qd_})
    std::fill(sum->begin(), sum->end(), 0);
  if (held != forces_.held()) forces_.prepare(w, held);
  const At at{held, x, k, w};

  iterate(
      at, kProjectionRounding, [&] { return largest(loops.g()); },
      [&] {
        q_before_ = x.q;
        forces_.correction(loops.g(), delta_);
        integrate_coordinates(*model_, x.q, delta_, x.q);
        apply_mimics(*model_, x);
        add(delta_, 1, correction_q_);
        forces_.add_lambda(1, lambda_q_);
      },
      [&] {
        x.q = q_before_;
        add(delta_, -1, correction_q_);
        forces_.add_lambda(-1, lambda_q_);
      });
  double fastest = 1;
  for (const double v : x.qd) fastest = std::max(fastest, std::abs(v));
  iterate(
      at, kProjectionRounding * fastest, [&] { return largest(loops.rate()); },
      [&] {
        qd_before_ = x.qd;
        forces_.correction(loops.rate(), delta_);
        add(delta_, 1, x.qd);
        for (const std::size_t d : held) x.qd[d] = 0;
        apply_mimics(*model_, x);
        add(delta_, 1, correction_qd_);
        forces_.add_lambda(1, lambda_qd_);
      },
      [&] {
        x.qd = qd_before_;
        add(delta_, -1, correction_qd_);
        forces_.add_lambda(-1, lambda_qd_);
      });
  return largest(loops.g());
}

}  // namespace twinarm
