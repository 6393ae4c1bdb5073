// Where Coulomb friction changes its kind within a step: a joint comes to rest, or breaks loose.
//
// Integrators other than the semi-implicit ones keep, over a step, the kind of friction that each
// dof has at its start: it slides one way, or is held (ForwardDynamics::Rule::as_chosen). The step
// is then smooth and has its full order. It is valid as far as
//   g(s) = min over dofs of { direction * velocity      of those that slide and do so at the start,
//                             what is left to the limit of those that are held }
// is positive at its end. Where it is not, the first s with g = 0 is found by regula falsi
// (Illinois), each trial a step of s from the start; what has come to rest there gets v = 0
// exactly, the kinds are chosen anew, and the rest of the step follows. A dof that friction can
// hold thus stays at rest; one that it cannot hold turns round.
// Not looked for within a step: velocities that pass through zero an even number of times; and what
// starts the step at v = 0 and slides against its direction at the end: v = 0 there.
#pragma once

#include <vector>

#include "solver/integration/integration_state.h"

namespace twinarm {

// g of a step: start() at m.x after m.accelerate(), then as a function of where the step led, with
// the last acceleration `as chosen` there if anything is held.
class FrictionEventFunction {
 public:
  explicit FrictionEventFunction(std::size_t families) : slid_(families) {}
  void start(const IntegrationState& m);
  double at_start() const { return at_start_; }
  double operator()(const ForwardDynamics& dynamics, const State<double>& x) const;

 private:
  std::vector<char> slid_;  // by family: at the start, in the direction chosen
  double at_start_ = 0;
};

// The s in (0, length] where g comes down to zero, or a hair beyond. g(s) takes the trial of length
// s; that of the s returned is the last one taken. g(length) = g_end < 0 has been taken already.
template <class G>
double step_to_zero(double length, double g_start, double g_end, G&& g) {
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

// Of integrators with a fixed step.
class FrictionEventLocator {
 public:
  static constexpr int kMaxEvents = 20;  // in one step; then its rest is taken as a whole
  explicit FrictionEventLocator(const IntegrationState& m)
      : margin_(m.dynamics.families().size()), start_(m.x) {}

  // Moves m.x by h in pieces, its time too but for the last one. step(s) moves m.x by s, but for
  // its time and kinematics. Returns the number of events.
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
        if (m.dynamics.holds_any()) m.accelerate_end(start_.t + s);
        return margin_(m.dynamics, m.x);
      };
      const double rest = h - done, g_end = trial(rest), g_start = margin_.at_start();
      const bool event = g_end < 0 && g_start > 0 && events < kMaxEvents;
      if (event) done += step_to_zero(rest, g_start, g_end, trial);
      m.dynamics.settle(m.x);
      if (!event) return events;
      m.x.t = t + done;
      m.refresh();
    }
  }

 private:
  FrictionEventFunction margin_;
  State<double> start_;
};

}  // namespace twinarm
