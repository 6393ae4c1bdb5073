// The last resort of impulse_solver.h: the central path of interior_point.cpp is followed from a
// problem that has one solution to the exact law, round all of its turns.
//
//   x o z = s e,    z = T (u + l mu |u_t|_s e_n),    p = T x,    l = max(0, 1 - s/s0),
//   |u_t|_s^2 = |u_t|^2 + (r s/s0)^2
//
// with r the velocities at stake: the corner that |u_t| has at rest is rounded, the less the
// smaller s.
// At s = s0 nothing is lifted: that is a convex problem. From there the solutions form a curve that
// leads to s = 0, where l = 1, if contacts can part at all (Jv + b within K* for some v; then all
// on it is bounded, which is also what Acary, Cadoux, Lemarechal and Malick 2011 ask for). On its
// way s may have to grow again, where Newton's method with falling s has nowhere to go. So s is an
// unknown too (Allgower and Georg 2003, chapters 2 and 6):
//   predictor  along the tangent dw/ds, towards sign(ds) = -sign(det), which is the same all along
//              the curve, by a length of at most 1 as a part of x and z;
//   corrector  Newton's method on the plane across the tangent; if it does not come near soon,
//   back,
//              and less far.
// Lengths are measured in Nesterov and Todd's scaling. Twenty to three hundred factorisations.
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/impulses/impulse_solver.h"
#include "solver/impulses/ipm_equations.h"

namespace twinarm {
namespace {

constexpr int max_steps = 1500, max_corrections = 5, max_starting = 60;
constexpr double near = 0.1, slow = 0.7, shorter = 0.3, longest = 0.95, shortest = 1e-6;
constexpr double sharp = 1e-3;  // a turn by more than 90 degrees within that length is one
constexpr double boundary = 0.95;
constexpr double infinity = std::numeric_limits<double>::infinity();

// W^-1 x
ConeVec divided(const ConeScaling& s, const ConeVec& x) {
  const ConeVec y = times(s.W, {x[0], -x[1], -x[2]});
  return {y[0] / s.eta2, -y[1] / s.eta2, -y[2] / s.eta2};
}

}  // namespace

struct ImpulseSolver::Path {
  ImpulseSolver& of;
  ImpulseProblem& problem;
  const Island& island;
  double s0, s = s0, length = 0.3;
  double size = infinity;  // of the last correction
  int corrections = 0;     // since the last predictor
  enum class At { start, corrected, predicted, back } at = At::start;

  template <class F>
  void for_each_cone(F&& f) const {
    for (const int i : of.cones_) f(i);
  }
  template <class F>
  void for_each_velocity(F&& f) const {
    for (const int t : island.trees)
      for (std::size_t k = 0; k < static_cast<std::size_t>(problem.size(t)); ++k)
        f(problem.first(t) + k);
  }

  // Of W dz and W^-1 dx of two directions, over those of z and x.
  double inner(const Turn& a, const Turn& b) const {
    double sum = a.s * b.s;
    for_each_cone([&](int i) {
      const ConeScaling& w = of.scaling_[i];
      sum += (cone_dot(times(w.W, a.z[i]), times(w.W, b.z[i])) +
              cone_dot(divided(w, a.x[i]), divided(w, b.x[i]))) /
             cone_dot(w.t, w.t);
    });
    return sum;
  }
  double largest(const Turn& a) const {
    double most = a.s * a.s;
    for_each_cone([&](int i) {
      const ConeScaling& w = of.scaling_[i];
      const ConeVec z = times(w.W, a.z[i]), x = divided(w, a.x[i]);
      const double here = std::max(cone_dot(z, z), cone_dot(x, x)) / cone_dot(w.t, w.t);
      most = here <= most ? most : here;  // keeps what is not a number
    });
    return std::sqrt(most);
  }
  // a = f a + g b
  void mix(Turn& a, double f, double g, const Turn& b) const {
    for_each_cone([&](int i) {
      for (std::size_t r = 0; r < 3; ++r) {
        a.x[i][r] = f * a.x[i][r] + g * b.x[i][r];
        a.z[i][r] = f * a.z[i][r] + g * b.z[i][r];
      }
    });
    for_each_velocity([&](std::size_t k) { a.v[k] = f * a.v[k] + g * b.v[k]; });
    a.s = f * a.s + g * b.s;
  }
  // How much of a direction, at most all, leaves x, z and s positive.
  double room(const Turn& a) const {
    double farthest = a.s < 0 ? -1 / a.s : infinity;
    for_each_cone([&](int i) {
      farthest = std::min({farthest, cone_step(of.x_[i], a.x[i]), cone_step(of.z_[i], a.z[i])});
    });
    return std::min(1.0, boundary * farthest);
  }
  void go(const Turn& a) {
    const double step = room(a);
    for_each_cone([&](int i) {
      for (std::size_t r = 0; r < 3; ++r)
        of.x_[i][r] += step * a.x[i][r], of.z_[i][r] += step * a.z[i][r];
    });
    for_each_velocity([&](std::size_t k) { problem.v(0)[k] += step * a.v[k]; });
    s *= 1 + step * a.s;
  }

  void find_directions();
  void predict(bool again);
  void restore();
  bool step();
};

// correction_: to the curve, s held. tangent_: along it, for ds = s.
void ImpulseSolver::Path::find_directions() {
  of.assemble(problem, island, false);
  of.matrix_.factorise(false);
  const auto take = [&](Turn& out, double change) {
    std::swap(out.x, of.dx_), std::swap(out.z, of.dz_), std::swap(out.v, of.dv_);
    out.s = change;
  };
  of.direct_centrally(problem, island, s, false);
  take(of.correction_, 0);
  const double rise = s < s0 ? s / s0 : 0;  // -dl for ds = s
  for_each_cone([&](int i) {
    of.right_[i] = {s * of.terms_[i].weight, 0, 0};
    of.d_z_[i] = {};
    if (!is_contact(problem.constraints()[i])) return;
    for (int k = i; k >= 0; k = of.next_disc_[k]) {
      const ConeTerms& terms = of.terms_[k];
      const double corner = of.rounded_ * terms.corner;
      const double from_s = terms.slip > 0 ? corner * corner / terms.slip : 0;
      of.d_z_[i][0] += terms.arm * (of.shift_part_ * from_s - rise * terms.slip);
    }
  });
  of.solve_centrally(problem, island, of.d_z_, 0);
  take(of.tangent_, 1);
}

// From a point of the curve, which is kept, along its tangent; what is left of the correction is
// done at once.
void ImpulseSolver::Path::predict(bool again) {
  const double way = -of.matrix_.determinant_sign() / largest(of.tangent_);
  if (!again) {
    if (corrections == 0 && at != At::start) length = std::min(longest, 2 * length);
    for_each_cone([&](int i) { of.saved_.x[i] = of.x_[i], of.saved_.z[i] = of.z_[i]; });
    for_each_velocity([&](std::size_t k) { of.saved_.v[k] = problem.v(0)[k]; });
    of.saved_.s = s;
  }
  mix(of.tangent_, way, 0, of.tangent_);
  std::swap(of.last_, of.tangent_);
  mix(of.correction_, 1, length * room(of.last_), of.last_);
  go(of.correction_);
  corrections = 0, size = infinity, at = At::predicted;
}

void ImpulseSolver::Path::restore() {
  for_each_cone([&](int i) { of.x_[i] = of.saved_.x[i], of.z_[i] = of.saved_.z[i]; });
  for_each_velocity([&](std::size_t k) { problem.v(0)[k] = of.saved_.v[k]; });
  s = of.saved_.s;
  length *= shorter;
  at = At::back;
}

// One correction, or one prediction where that is small. False if there is nowhere to go.
bool ImpulseSolver::Path::step() {
  find_directions();
  Turn &correction = of.correction_, &tangent = of.tangent_;
  if (at == At::start) {  // to the curve, s held
    const double left = largest(correction);
    if (left <= near)
      predict(false);
    else
      go(correction);
    return left < infinity;
  }
  const Turn& across = at == At::back ? tangent : of.last_;
  mix(correction, 1, -inner(correction, across) / inner(tangent, across), tangent);
  if (at == At::back) {
    predict(true);
    return length > shortest;
  }
  const double before = size;
  size = largest(correction);
  const int sign = -of.matrix_.determinant_sign();
  if (size <= near && (length < sharp || sign * inner(tangent, of.last_) > 0))
    predict(false);
  else if (size > near && size < slow * before && corrections < max_corrections)
    ++corrections, go(correction);
  else
    restore();
  return length > shortest;
}

// Another curve for each `which`. p of the constraints is the best that was met. Returns the steps.
int ImpulseSolver::follow_path(ImpulseProblem& problem, const Island& island, int which) {
  const double s0 = begin_centrally(problem, island, which);
  for (Turn* turn : {&correction_, &tangent_, &last_, &saved_}) {
    turn->v.resize(problem.nv());
    turn->x.resize(x_.size()), turn->z.resize(x_.size());
  }
  d_z_.resize(x_.size());
  Path path{*this, problem, island, s0};
  double best = infinity;
  int steps = 0;
  for (; s0 > 0 && steps < max_steps; ++steps) {
    shift_part_ = std::max(0.0, 1 - path.s / s0);
    rounded_ = path.s / s0;
    double residual = 0;
    const bool inside = measure_centrally(problem, island, residual) > 0 && residual < 1e100;
    if (inside && residual < best) {
      best = residual;
      for (const int i : island.constraints) kept_[i] = p_[i];
    }
    if (path.at == Path::At::start && steps > max_starting) break;
    if (residual <= 0.5 * accepted || path.s > 2 * s0) break;
    if (inside) {
      if (!path.step()) break;
    } else {
      if (path.at == Path::At::start) break;
      path.restore();
    }
  }
  if (best < infinity)
    for (const int i : island.constraints) problem.constraints()[i].p = kept_[i];
  return steps;
}

}  // namespace twinarm
