// Oracle of coupling/analysis/multi_joint_tracking.h for one degree of freedom: the error in closed
// form.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "coupling/analysis/tracking.h"

namespace twinarm::testing {

// Closed-form error for such a profile, from rest with e = 0.
class ProfileError {
 public:
  enum class Damper { relative, absolute };
  ProfileError(MotionProfile move, double distance, double time, double omega, double zeta,
               Damper damper = Damper::relative);
  // At a time t >= 0.
  double at(double t) const;
  // Maximum |e|.
  double peak() const;

 private:
  // Right-hand side; the particular solution has the same form.
  using Forcing = ProfileSegment::Series;
  struct Piece {
    double start = 0, jump = 0;  // as ProfileSegment
    Forcing right, particular;
    double e = 0, e_dot = 0;  // initial values of the homogeneous solution
  };
  void add_piece(const ProfileSegment& move);
  void solve();
  struct Motion {
    double e, e_dot;
  };
  Motion of_particular(const Piece& piece, double s) const;
  Motion free_motion(double e, double e_dot, double s) const;
  Motion in_piece(const Piece& piece, double s) const {
    const Motion of = of_particular(piece, s), free = free_motion(piece.e, piece.e_dot, s);
    return {of.e + free.e, of.e_dot + free.e_dot};
  }

  double time_, omega_, zeta_, W_;  // [s], [rad/s], 1, [rad/s]
  Damper damper_;
  std::vector<Piece> pieces_;
};

inline ProfileError::ProfileError(MotionProfile move, double D, double T, double omega, double zeta,
                                  Damper damper)
    : time_(T), omega_(omega), zeta_(zeta), W_(std::numbers::pi / T), damper_(damper) {
  for (const ProfileSegment& piece : segments_of(move, D, T)) add_piece(piece);
  solve();
}

inline void ProfileError::add_piece(const ProfileSegment& move) {
  Piece piece{move.start, move.jump, move.acceleration, {}};
  const Forcing& velocity = move.velocity;
  if (damper_ == Damper::absolute) {
    const double by = 2 * zeta_ * omega_;
    std::vector<double>& power = piece.right.power;
    power.resize(std::max(power.size(), velocity.power.size()));
    for (std::size_t n = 0; n < velocity.power.size(); ++n) power[n] += by * velocity.power[n];
    piece.right.c += by * velocity.c;
    piece.right.d += by * velocity.d;
  }
  pieces_.push_back(std::move(piece));
}

// Powers, from the highest down: w^2 p_n + 2 z w (n+1) p_n+1 + (n+1)(n+2) p_n+2 = f_n.
// (c cos + d sin): (w^2 - W^2) C + 2 z w W D = c,  (w^2 - W^2) D - 2 z w W C = d.
inline void ProfileError::solve() {
  const double w2 = omega_ * omega_, b = 2 * zeta_ * omega_;
  Motion end{0, 0};
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    Piece& piece = pieces_[i];
    const std::vector<double>& f = piece.right.power;
    std::vector<double>& p = piece.particular.power;
    p.assign(f.size() + 2, 0.0);
    for (std::size_t n = f.size(); n-- > 0;) {
      const auto m = static_cast<double>(n);
      p[n] = (f[n] - b * (m + 1) * p[n + 1] - (m + 1) * (m + 2) * p[n + 2]) / w2;
    }
    const double stiff = w2 - W_ * W_, damp = b * W_;
    if (piece.right.c != 0 || piece.right.d != 0) {
      const double all = stiff * stiff + damp * damp;
      piece.particular.c = (stiff * piece.right.c - damp * piece.right.d) / all;
      piece.particular.d = (stiff * piece.right.d + damp * piece.right.c) / all;
    }
    const Motion of = of_particular(piece, 0);
    piece.e = end.e - of.e;
    piece.e_dot = end.e_dot + piece.jump - of.e_dot;
    if (i + 1 < pieces_.size()) end = in_piece(piece, pieces_[i + 1].start - piece.start);
  }
}

inline ProfileError::Motion ProfileError::of_particular(const Piece& piece, double s) const {
  Motion motion{0, 0};
  const std::vector<double>& p = piece.particular.power;
  for (std::size_t n = p.size(); n-- > 0;) {
    motion.e_dot = motion.e_dot * s + motion.e;
    motion.e = motion.e * s + p[n];
  }
  const double C = piece.particular.c, D = piece.particular.d;
  const double cos = std::cos(W_ * s), sin = std::sin(W_ * s);
  return {motion.e + C * cos + D * sin, motion.e_dot + W_ * (D * cos - C * sin)};
}

// e'' + 2 z w e' + w^2 e = 0. With r^2 = w^2 |1 - z^2|, c and s of cos, sin or of cosh, sinh:
// e = exp(-z w t) (e_0 c(r t) + (e'_0 + z w e_0) s(r t)/r).
inline ProfileError::Motion ProfileError::free_motion(double e, double e_dot, double t) const {
  const double r = omega_ * std::sqrt(std::abs(1 - zeta_ * zeta_)), zw = zeta_ * omega_;
  const double rate = e_dot + zw * e;
  double c, s_by_r, back;  // back: of c' = back s_by_r
  if (r * t < 1e-8) {
    c = std::exp(-zw * t);
    s_by_r = t * c;
    back = 0;
  } else if (zeta_ < 1) {
    c = std::exp(-zw * t) * std::cos(r * t);
    s_by_r = std::exp(-zw * t) * std::sin(r * t) / r;
    back = -r * r;
  } else {  // both exponentials decay: no overflow
    const double slow = std::exp((r - zw) * t), fast = std::exp(-(r + zw) * t);
    c = (slow + fast) / 2;
    s_by_r = (slow - fast) / (2 * r);
    back = r * r;
  }
  const double now = e * c + rate * s_by_r;
  return {now, -zw * now + e * back * s_by_r + rate * c};
}

inline double ProfileError::at(double t) const {
  const Piece* piece = &pieces_.front();
  for (const Piece& next : pieces_)
    if (t >= next.start) piece = &next;
  return in_piece(*piece, t - piece->start).e;
}

// Maximum on a fine grid over the move and one period after it, on a finer one around it.
inline double ProfileError::peak() const {
  constexpr double kPerPeriod = 400, kMin = 4000, kMax = 4e6;
  const double period = 2 * std::numbers::pi / omega_, end = time_ + period;
  const double count = std::clamp(kPerPeriod * end / period, kMin, kMax), dt = end / count;
  const auto size = [&](double n) { return std::abs(at(n * dt)); };
  double best = 0, where = 0;
  for (double n = 0; n <= count; ++n)
    if (const double here = size(n); here > best) {
      best = here;
      where = n;
    }
  if (where < 1) return best;
  for (int k = 1; k < 1000; ++k) best = std::max(best, size(where - 1 + k / 500.0));
  return best;
}

}  // namespace twinarm::testing
