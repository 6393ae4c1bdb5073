#include "solver/loops/loop_projection.h"

#include <algorithm>
#include <cmath>

#include "solver/model/configuration.h"
#include "solver/model/mimic.h"

namespace twinarm {
namespace {

constexpr int kMaxProjections = 20;
// Of 1 m or rad, and of the largest velocity: what is not moved any more, and where iterations that
// stall have come down to rounding. Little, as near a singular place much of a velocity can hide
// behind a small g'.
constexpr double kProjectionRounding = 5e-16, kStalls = 2e-14;

double largest(const Eigen::VectorXd& v) {
  return v.size() == 0 ? 0 : v.lpNorm<Eigen::Infinity>();
}

void add(const std::vector<double>& shift, double part, std::vector<double>& sum) {
  for (std::size_t d = 0; d < sum.size(); ++d) sum[d] += part * shift[d];
}

}  // namespace

void LoopProjection::start(const ConstraintForceSolver& prepared,
                           const std::vector<std::size_t>& held, const State<double>& x,
                           const Kinematics& k, Workspace<double>& w) noexcept {
  forces_.take_factors(prepared);
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

// size(): what is to become zero. move(): one correction. restore(): takes it back.
template <class Size, class Move, class Restore>
void LoopProjection::iterate(const At& at, double rounding, Size&& size, Move&& move,
                             Restore&& restore) {
  const auto look = [&] {
    forward_kinematics(*model_, at.x, at.k);
    forces_.loops().evaluate(at.x, at.k);
  };
  double open = size();
  bool fresh = false;
  for (int n = 0; n < kMaxProjections && open > rounding; ++n) {
    move();
    look();
    const double then = size();
    if (then < 0.5 * open) {
      open = then;
      continue;
    }
    const bool stalls = open <= kStalls / kProjectionRounding * rounding;
    if (stalls && then <= open) return;
    restore();
    look();
    if (fresh || stalls) return;
    // Rows of a loop that is open by some angle are known to that angle, their squares in G to its
    // square.
    forces_.prepare(at.w, at.held, std::max(PivotedCholesky::kDependent, open * open));
    fresh = true;
  }
}

double LoopProjection::operator()(const std::vector<std::size_t>& held, State<double>& x,
                                  Kinematics& k, Workspace<double>& w) noexcept {
  LoopClosures& loops = forces_.loops();
  loops.evaluate(x, k);
  std::fill(moved_q_.begin(), moved_q_.end(), 0);
  std::fill(moved_qd_.begin(), moved_qd_.end(), 0);
  std::fill(pushed_q_.begin(), pushed_q_.end(), 0);
  std::fill(pushed_qd_.begin(), pushed_qd_.end(), 0);
  if (held != forces_.held()) forces_.prepare(w, held);
  const At at{held, x, k, w};

  iterate(
      at, kProjectionRounding, [&] { return largest(loops.g()); },
      [&] {
        q_before_ = x.q;
        forces_.correction(loops.g(), shift_);
        integrate_coordinates(*model_, x.q, shift_, x.q);
        apply_mimics(*model_, x);
        add(shift_, 1, moved_q_);
        forces_.add_lambda(1, pushed_q_);
      },
      [&] {
        x.q = q_before_;
        add(shift_, -1, moved_q_);
        forces_.add_lambda(-1, pushed_q_);
      });
  double fastest = 1;
  for (const double v : x.qd) fastest = std::max(fastest, std::abs(v));
  iterate(
      at, kProjectionRounding * fastest, [&] { return largest(loops.rate()); },
      [&] {
        qd_before_ = x.qd;
        forces_.correction(loops.rate(), shift_);
        add(shift_, 1, x.qd);
        for (const std::size_t d : held) x.qd[d] = 0;
        apply_mimics(*model_, x);
        add(shift_, 1, moved_qd_);
        forces_.add_lambda(1, pushed_qd_);
      },
      [&] {
        x.qd = qd_before_;
        add(shift_, -1, moved_qd_);
        forces_.add_lambda(-1, pushed_qd_);
      });
  return largest(loops.g());
}

}  // namespace twinarm
