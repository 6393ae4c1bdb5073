// Passivity observer and controller of force feedback (Hannaford and Ryu 2002), with the actual
// work of the held force (Ryu, Kim and Hannaford 2004; docs/understand/haptic_rendering.md):
//
//   E_n = E_n-1 - F_n-1 . (x_n - x_n-1)        energy received from the operator
//
// F: force on the operator, clamped and damped, held from tick n-1 to tick n (published with f =
// -F). E < 0: energy was created. The controller predicts one tick: if the last motion d were
// repeated and E would become negative, the wanted force w is damped along d,
//
//   E_n >= 0:  F = w - alpha d,  alpha = max(0, (w . d - E_n)/d^2)
//   E_n <  0:  F = -alpha d,     alpha = min(-2 E_n/d^2, alpha_max)        damping only
//
// so that a deficit is removed by the next tick, even if it moves by d/2 only. The damping is kept
// until the device moves again. alpha_max: limit for the device's own mass, m/(2 T^2), beyond which
// the damping oscillates. A held force cannot exclude negative energy if the motion reverses within
// a tick; the guaranteed bound is: the allowed force decreases from the peak at E = 0 to almost
// zero at E = -W, W = peak . (maximum motion per tick), so motions within that maximum never lower
// E below -W.
//
// Also for joint angles and torques; for one coordinate leave the other two at zero. Nothing throws
// or allocates.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/spatial/pose.h"

namespace twinarm {

class PassivityControl {
 public:
  // W [J]; alpha_max [N/m], [N m/rad].
  explicit PassivityControl(double work_per_tick,
                            double max_damping = std::numeric_limits<double>::infinity())
      : max_(work_per_tick), lowest_(-work_per_tick), max_damping_(max_damping) {}

  // A tick, in this order. Position of the device; updates the energy.
  void set_position(const Vector3& x) noexcept;
  // The wanted force on the operator with the damping required for passivity.
  Vector3 passive_force(const Vector3& wanted) const noexcept;
  // Allowed fraction of the peak force, 0 to 1, for the caller's clamp.
  double force_fraction() const noexcept;
  // Force held until the next tick.
  void set_held_force(const Vector3& force) noexcept { held_ = force; }

  // All four, with a clamp of |F| to `peak`.
  Vector3 tick(const Vector3& x, const Vector3& wanted, double peak) noexcept;

  double energy() const { return E_; }  // [J]

 private:
  double max_, lowest_;  // W, and the minimum of E so far, at most -W
  double max_damping_;
  double E_ = 0;
  bool placed_ = false;
  Vector3 x_ = Vector3::Zero(), d_ = Vector3::Zero(), held_ = Vector3::Zero();
};

// A sampled haptic device at a two-sided virtual wall, one-dimensional
// (docs/understand/haptic_rendering.md):
//
//   m x'' = -b x' - f_c sign x' + F,     F held over a tick T = 1/rate:
//   F_n = -K y - B (y - y_before)/T,     y = x sampled `delay` ticks ago, in steps of `resolution`
//
// Between ticks the solution is exact. Closed-form limits, and limits by bisection of K on
// simulations:
//   stable    the free device comes to rest (linear: no friction, no quantisation)
//   passive   no operator motion extracts energy: x = A cos(w n T), linear between ticks (minimum
//             dissipation), at all harmonics w of 512 ticks and amplitudes from small to large
// Cost: about 10 ms each.
struct SampledDevice {
  double mass = 0.045, damping = 0.1;  // m [kg], b [N s/m]
  double friction = 0;                 // f_c [N]
  double resolution = 0;               // of the encoder, Delta [m]
  double rate = 1000;                  // [Hz]
  int delay = 0;                       // from sensor to motor, without the hold [ticks]
  double tick() const { return 1 / rate; }
};

// Closed-form limits of K [N/m] at a wall damping B [N s/m]; >= 0.
// Colgate and Schenkel 1994: b > K T/2 + |B|; a delay of d ticks: b > K T (d + 1/2), B = 0 only.
inline double colgate_stiffness(const SampledDevice& device, double B) {
  return std::max(0.0, (device.damping - std::abs(B)) / (device.tick() * (device.delay + 0.5)));
}
// Gil, Avello, Rubio, Florez 2004; Hulin, Preusche, Hirzinger 2006: K < (b + B)/(T/2 + t_d).
inline double uncoupled_stiffness(const SampledDevice& device, double B) {
  return std::max(0.0, (device.damping + B) / (device.tick() * (device.delay + 0.5)));
}
// Abbott and Okamura 2005, B = 0: K <= min(2 b/T, 2 f_c/Delta).
double abbott_okamura_stiffness(const SampledDevice& device);

// Whether the free device comes to rest at this wall.
bool is_stable(const SampledDevice& device, double K, double B);
// Whether the operator's work over a cycle is non-negative for all motions above.
bool is_passive(const SampledDevice& device, double K, double B);

// By bisection, relative accuracy 1e-5; 0 if there is none.
double max_stable_stiffness(const SampledDevice& device, double B);
double max_passive_stiffness(const SampledDevice& device, double B);
double max_passive_damping(const SampledDevice& device, double K);

}  // namespace twinarm
