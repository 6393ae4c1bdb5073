// Last stage of island_solver.h: homotopy along the central path of interior_point.cpp, from a
// convex problem with a unique solution to the exact law, with path following around turning
// points.
//
//   x o z = s e,    z = T (u + l mu |u_t|_s e_n),    p = T x,    l = max(0, 1 - s/s0),
//   |u_t|_s^2 = |u_t|^2 + (r s/s0)^2
//
// r: a velocity scale that smooths the kink of |u_t| at u_t = 0; vanishes with s.
// At s = s0 the de Saxce shift is zero: a convex problem. From there the solutions form a curve to
// s = 0, where l = 1, if the contacts can separate (J v + b in K* for some v; the curve is then
// bounded; the same condition as in Acary, Cadoux, Lemarechal and Malick 2011). s can increase
// along the curve, so it is an unknown too (Allgower and Georg 2003, chapters 2 and 6):
//   predictor  along the tangent dw/ds with sign(ds) = -sign(det), constant along the curve; length
//              at most 1 relative to x and z
//   corrector  Newton's method in the plane normal to the tangent; without fast convergence back to
//              the last point with a shorter predictor
// Lengths are measured in the Nesterov-Todd scaling. Cost: 20 to 300 factorisations.
#include <cmath>
#include <limits>

#include "solver/impulses/interior_phase.h"

namespace twinarm {
namespace {

constexpr int kMaxSteps = 1500, kMaxCorrections = 5, kMaxStartSteps = 60;
constexpr double kNear = 0.1, kSlow = 0.7, kShorten = 0.3, kMaxLength = 0.95, kMinLength = 1e-6;
constexpr double kSharpTurn = 1e-3;  // below this length, turns above 90 degrees are accepted
constexpr double kToBoundary = 0.95;
constexpr double infinity = std::numeric_limits<double>::infinity();

// W^-1 x
ConeVec divided(const ConeScaling& s, const ConeVec& x) {
  const ConeVec y = times(s.W, {x[0], -x[1], -x[2]});
  return {y[0] / s.eta2, -y[1] / s.eta2, -y[2] / s.eta2};
}

}  // namespace

struct InteriorPhase::CentralPath {
  InteriorPhase& of;
  double s0, s = s0, length = 0.3;
  double size = infinity;  // of the last correction
  int corrections = 0;     // since the last predictor
  enum class At { start, predicted, back } at = At::start;

  template <class F>
  void for_each_cone(F&& f) const {
    for (const int i : of.cones_) f(i);
  }

  // Inner product of W dz and W^-1 dx of two directions, relative to those of z and x.
  double inner(const Direction& a, const Direction& b) const {
    double sum = a.s * b.s;
    for_each_cone([&](int i) {
      const ConeScaling& w = of.scaling_[i];
      sum += (cone_dot(times(w.W, a.z[i]), times(w.W, b.z[i])) +
              cone_dot(divided(w, a.x[i]), divided(w, b.x[i]))) /
             cone_dot(w.t, w.t);
    });
    return sum;
  }
  double largest(const Direction& a) const {
    double max = a.s * a.s;
    for_each_cone([&](int i) {
      const ConeScaling& w = of.scaling_[i];
      const ConeVec z = times(w.W, a.z[i]), x = divided(w, a.x[i]);
      const double here = std::max(cone_dot(z, z), cone_dot(x, x)) / cone_dot(w.t, w.t);
      max = nan_max(max, here);
    });
    return std::sqrt(max);
  }
  // a = f a + g b
  void mix(Direction& a, double f, double g, const Direction& b) const {
    for_each_cone([&](int i) {
      for (std::size_t r = 0; r < 3; ++r) {
        a.x[i][r] = f * a.x[i][r] + g * b.x[i][r];
        a.z[i][r] = f * a.z[i][r] + g * b.z[i][r];
      }
    });
    of.island_.for_each_velocity([&](std::size_t k) { a.v[k] = f * a.v[k] + g * b.v[k]; });
    a.s = f * a.s + g * b.s;
  }
  // Maximum step, at most 1, with x and z in their cones and s positive.
  double max_step(const Direction& a) const {
    double limit = a.s < 0 ? -1 / a.s : infinity;
    for_each_cone([&](int i) {
      limit = std::min({limit, cone_step(of.x_[i], a.x[i]), cone_step(of.z_[i], a.z[i])});
    });
    return std::min(1.0, kToBoundary * limit);
  }
  void advance(const Direction& a) {
    const double step = max_step(a);
    for_each_cone([&](int i) {
      for (std::size_t r = 0; r < 3; ++r)
        of.x_[i][r] += step * a.x[i][r], of.z_[i][r] += step * a.z[i][r];
    });
    of.island_.for_each_velocity(
        [&](std::size_t k) { of.island_.problem->v(0)[k] += step * a.v[k]; });
    s *= 1 + step * a.s;
  }

  // correction_: towards the curve at constant s. tangent_: along the curve, for ds = s.
  void find_directions() {
    of.matrix_.factorise(false);
    const auto take = [&](Direction& out, double change) {
      std::swap(out.x, of.dx_), std::swap(out.z, of.dz_), std::swap(out.v, of.island_.dv);
      out.s = change;
    };
    of.find_direction(s, false);
    take(of.correction_, 0);
    const double rise = s < s0 ? s / s0 : 0;  // -dl for ds = s
    for_each_cone([&](int i) {
      of.right_[i] = {s, 0, 0};
      of.d_z_[i] = {};
      if (!is_contact(of.island_.constraint(i))) return;
      for (int k = i; k >= 0; k = of.island_.next_disc[k]) {
        const ConeTerms& terms = of.terms_[k];
        const double kink = of.smoothing_ * terms.kink;
        const double from_s = terms.slip > 0 ? kink * kink / terms.slip : 0;
        of.d_z_[i][0] += terms.arm * (of.shift_factor_ * from_s - rise * terms.slip);
      }
    });
    of.solve_kkt(of.d_z_, 0);
    take(of.tangent_, 1);
  }
  // Saves the point, unless repeated, and advances along the tangent, combined with the remaining
  // correction.
  void predict(bool repeated) {
    const double scale = -of.matrix_.determinant_sign() / largest(of.tangent_);
    if (!repeated) {
      if (corrections == 0 && at != At::start) length = std::min(kMaxLength, 2 * length);
      for_each_cone([&](int i) { of.saved_.x[i] = of.x_[i], of.saved_.z[i] = of.z_[i]; });
      of.island_.for_each_velocity(
          [&](std::size_t k) { of.saved_.v[k] = of.island_.problem->v(0)[k]; });
      of.saved_.s = s;
    }
    mix(of.tangent_, scale, 0, of.tangent_);
    std::swap(of.last_, of.tangent_);
    mix(of.correction_, 1, length * max_step(of.last_), of.last_);
    advance(of.correction_);
    corrections = 0, size = infinity, at = At::predicted;
  }
  void restore() {
    for_each_cone([&](int i) { of.x_[i] = of.saved_.x[i], of.z_[i] = of.saved_.z[i]; });
    of.island_.for_each_velocity(
        [&](std::size_t k) { of.island_.problem->v(0)[k] = of.saved_.v[k]; });
    s = of.saved_.s;
    length *= kShorten;
    at = At::back;
  }
  // One corrector step, or a predictor if the correction is small. False if the path cannot be
  // followed.
  bool step() {
    find_directions();
    Direction &correction = of.correction_, &tangent = of.tangent_;
    if (at == At::start) {  // towards the curve at constant s
      const double error = largest(correction);
      if (error <= kNear)
        predict(false);
      else
        advance(correction);
      return error < infinity;
    }
    const Direction& normal = at == At::back ? tangent : of.last_;
    mix(correction, 1, -inner(correction, normal) / inner(tangent, normal), tangent);
    if (at == At::back) {
      predict(true);
      return length > kMinLength;
    }
    const double before = size;
    size = largest(correction);
    const int sign = -of.matrix_.determinant_sign();
    if (size <= kNear && (length < kSharpTurn || sign * inner(tangent, of.last_) > 0))
      predict(false);
    else if (size > kNear && size < kSlow * before && corrections < kMaxCorrections)
      ++corrections, advance(correction);
    else
      restore();
    return length > kMinLength;
  }
};

int InteriorPhase::follow_path(int start) {
  const double s0 = initialize(start);
  for (Direction* direction : {&correction_, &tangent_, &last_, &saved_}) {
    direction->v.resize(island_.problem->nv());
    direction->x.resize(x_.size()), direction->z.resize(x_.size());
  }
  d_z_.resize(x_.size());
  CentralPath path{*this, s0};
  double best = infinity;
  int steps = 0;
  for (; s0 > 0 && steps < kMaxSteps && island_.has_budget(); ++steps) {
    shift_factor_ = std::max(0.0, 1 - path.s / s0);
    smoothing_ = path.s / s0;
    double residual = 0;
    const bool inside = evaluate(residual) > 0 && residual < 1e100;
    if (inside && residual < best) {
      best = residual;
      for (const int i : island_.constraints()) kept_[i] = island_.p[i];
    }
    if (path.at == CentralPath::At::start && steps > kMaxStartSteps) break;
    if (residual <= 0.5 * island_.wanted.accepted || path.s > 2 * s0) break;
    if (inside) {
      if (!path.step()) break;
    } else {
      if (path.at == CentralPath::At::start) break;
      path.restore();
    }
  }
  if (best < infinity)
    for (const int i : island_.constraints()) island_.constraint(i).p = kept_[i];
  return steps;
}

}  // namespace twinarm
