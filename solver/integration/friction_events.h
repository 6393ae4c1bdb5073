// Stick-slip transitions of joint friction within a step: a joint comes to rest or starts to slide.
//
// Integrators other than the semi-implicit ones keep the friction mode of each dof over a step
// (ForwardDynamics::FrictionRule::frozen_modes): the step is smooth and has its full order. It is
// valid while the event function
//   g(s) = min { direction * velocity  of dofs that slide at the start,
//                friction margin       of sticking dofs }
// is positive. If g < 0 at the end, the first zero of g is located by the Illinois variant of
// regula falsi, each evaluation a step of size s from the start. Dofs at rest there get v = 0
// exactly, the modes are determined again, and the remainder of the step follows. Not detected: an
// even number of zero crossings of a velocity within a step, and a dof that starts the step with v
// = 0 and ends it against its sliding direction (its velocity is set to 0).
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "solver/integration/integration_state.h"

namespace twinarm {

// Event function g of a step: start() at m.x after m.accelerate(); then evaluated at the state that
// the step reached, after an acceleration by frozen_modes there if any dof is sticking.
class FrictionEventFunction {
 public:
  explicit FrictionEventFunction(std::size_t groups) : sliding_(groups) {}
  void start(const IntegrationState& m) {
    const ForwardDynamics& dynamics = m.dynamics;
    for (std::size_t k = 0; k < sliding_.size(); ++k)
      sliding_[k] = m.x.qd[dynamics.groups()[k].dof] * static_cast<double>(dynamics.mode(k)) > 0;
    at_start_ = (*this)(dynamics, m.x);
  }
  double at_start() const { return at_start_; }
  double operator()(const ForwardDynamics& dynamics, const State<double>& x) const {
    double g = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < sliding_.size(); ++k)
      if (sliding_[k])
        g = std::min(g, x.qd[dynamics.groups()[k].dof] * static_cast<double>(dynamics.mode(k)));
    return dynamics.any_sticking() ? std::min(g, dynamics.friction_margin() + kLimitTolerance) : g;
  }

 private:
  // A sticking dof starts to slide if its friction exceeds the limit by this fraction: well above
  // rounding, so that the mode at the new start is sliding.
  static constexpr double kLimitTolerance = 1e-10;
  std::vector<char> sliding_;  // by group, at the start of the step
  double at_start_ = 0;
};

// The s in (0, length] with g(s) = 0, or slightly beyond. g(s) performs a step of size s; the last
// call is at the s returned. g(length) = g_end < 0 has been evaluated by the caller.
template <class G>
double locate_zero(double length, double g_start, double g_end, G&& g) {
  double low = 0, high = length, weight_low = g_start, weight_high = g_end, s = length;
  int side = 0;
  for (int n = 0; n < 60 && high - low > 4e-16 * length; ++n) {
    s = low + (high - low) * weight_low / (weight_low - weight_high);
    if (!(s > low && s < high)) s = 0.5 * (low + high);
    if (s == low || s == high) break;
    const double g_s = g(s);
    if (g_s > 0) {
      low = s, weight_low = g_s;
      if (side > 0) weight_high *= 0.5;
      side = 1;
    } else {
      high = s, weight_high = g_s;
      if (-g_s <= 1e-13 * g_start) return s;
      if (side < 0) weight_low *= 0.5;
      side = -1;
    }
  }
  if (s != high) g(high);
  return high;
}

// For integrators of fixed step size.
class FrictionEventLocator {
 public:
  static constexpr int kMaxEvents = 20;  // per step; the remainder is one step
  explicit FrictionEventLocator(const IntegrationState& m)
      : margin_(m.dynamics.groups().size()), start_(m.x) {}

  // Advances m.x by h, divided at the events; the caller updates time and kinematics at the end.
  // step(s) advances m.x by s without time and kinematics. Returns the number of events.
  template <class Step>
  int advance(IntegrationState& m, double h, Step&& step) {
    const double t = m.x.t;
    double done = 0;
    for (int events = 0;; ++events) {
      m.accelerate();
      margin_.start(m);
      start_ = m.x;
      const auto trial = [&](double s) {
        m.x = start_;
        step(s);
        if (m.dynamics.any_sticking()) m.accelerate_end(start_.t + s);
        return margin_(m.dynamics, m.x);
      };
      const double rest = h - done, g_end = trial(rest), g_start = margin_.at_start();
      const bool event = g_end < 0 && g_start > 0 && events < kMaxEvents;
      if (event) done += locate_zero(rest, g_start, g_end, trial);
      m.dynamics.zero_sticking_velocities(m.x);
      if (!event) return events;
      m.x.t = t + done;
      m.project_and_update();
    }
  }

 private:
  FrictionEventFunction margin_;
  State<double> start_;
};

}  // namespace twinarm
