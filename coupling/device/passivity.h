// Passivity observer and controller of what a hand feels (Hannaford and Ryu 2002), with the work
// that the held force really does (Ryu, Kim and Hannaford 2004; docs/understand/haptic_rendering.md):
//
//   E_n = E_n-1 - F_n-1 . (x_n - x_n-1)        work of the hand on all that is behind the device
//
// F: the force ON the hand, clamped, damped, as the motors hold it from tick n-1 to tick n. (With
// f = -F, the hand's force, the published E_n = E_n-1 + f_n-1 . (x_n - x_n-1).) E < 0: more has
// come out than went in. The controller sees one tick ahead: were the hand to go on as in its last
// motion d, and E to be less than zero then, the wanted force w gets damping along d,
//
//   E_n >= 0:  F = w - alpha d,  alpha = max(0, (w . d - E_n)/d^2)
//   E_n <  0:  F = -alpha d,     alpha = min(-2 E_n/d^2, alpha_max)        nothing but damping
//
// so that a debt is paid back by the next tick that moves on, were it by half of d only. The
// damping stays until the hand moves again. alpha_max is what the device's own mass can bear, m/(2
// T^2): beyond, the damping itself throws a slow hand to and fro. No force that is held over a tick
// can pay for a hand that turns back within it; what is sure there is the floor: the force that is
// allowed goes from all of the peak at E = 0 to (next to) none at E = -W, W = peak . farthest, so
// no motions whatever of at most `farthest` a tick bring E below -W, one tick's work.
//
// Places and forces may be those of joints as well: angles and torques. One coordinate: leave the
// other two at zero. Nothing throws or allocates.
#pragma once

#include <limits>

#include "solver/spatial/pose.h"

namespace twinarm {

class PassivityControl {
 public:
  // W [J]; alpha_max [N/m], [N m/rad].
  explicit PassivityControl(double one_ticks_work,
                            double stiffest = std::numeric_limits<double>::infinity())
      : max_(one_ticks_work), lowest_(-one_ticks_work), stiffest_(stiffest) {}

  // A tick, in this order. Where the hand is now: the force that was held has done its work.
  void moved_to(const Vector3& x) noexcept;
  // The wanted force on the hand with the damping that passivity asks for.
  Vector3 damped(const Vector3& wanted) const noexcept;
  // Part of the peak force that is allowed, 0 to 1: for the caller's clamp.
  double allowance() const noexcept;
  // What the motors hold from now on.
  void holds(const Vector3& force) noexcept { held_ = force; }

  // All four, for a force whose length is at most `peak`.
  Vector3 tick(const Vector3& x, const Vector3& wanted, double peak) noexcept;

  double energy() const { return E_; }  // [J]

 private:
  double max_, lowest_;  // W, and the lowest that E has been, -W at most
  double stiffest_;
  double E_ = 0;
  bool placed_ = false;
  Vector3 x_ = Vector3::Zero(), d_ = Vector3::Zero(), held_ = Vector3::Zero();
};

// A haptic device against a virtual wall, tick by tick: which walls are stable, and which give no
// energy away. One direction; the wall pulls as well as it pushes (docs/understand/haptic_rendering.md).
//
//   m x'' = -b x' - f_c sign x' + F,     F held over a tick T = 1/rate:
//   F_n = -K y - B (y - y_before)/T,     y = x sampled `delay` ticks ago, in steps of `resolution`
//
// Between ticks the device is solved exactly. Laws stand beside what is measured; each measure is a
// bisection of K on runs of the recurrence, and knows no law:
//   stable    nobody holds the device: does it come to rest? (Linear: no friction, no steps.)
//   passive   some motion of a hand gets more work out than it puts in: x = A cos(w n T), straight
//             between ticks, at all harmonics w of 512 ticks, at amplitudes from small to large.
//             Straight is the way on which the damping takes least.
// Cost: about a hundredth of a second each.
struct SampledDevice {
  double mass = 0.045, damping = 0.1;  // m [kg], b [N s/m]
  double friction = 0;                 // f_c [N]
  double resolution = 0;               // of the encoder, Delta [m]
  double rate = 1000;                  // [Hz]
  int delay = 0;                       // from the sensor to the motor, beside the hold [ticks]
  double tick() const { return 1 / rate; }
};

// Laws, for the largest K [N/m] at a wall's damping B [N s/m]; not below 0.
// Colgate and Schenkel 1994: b > K T/2 + |B|; a delay of d ticks: b > K T (d + 1/2), B = 0 only.
double colgate_stiffness(const SampledDevice& device, double B);
// Gil, Avello, Rubio, Florez 2004; Hulin, Preusche, Hirzinger 2006: K < (b + B)/(T/2 + t_d).
double uncoupled_stiffness(const SampledDevice& device, double B);
// Abbott and Okamura 2005, B = 0: K <= min(2 b/T, 2 f_c/Delta).
double abbott_okamura_stiffness(const SampledDevice& device);

// Whether the device comes to rest at this wall, let go beside it.
bool is_stable(const SampledDevice& device, double K, double B);
// The least work [J] of the hand over a cycle, of all motions above, in parts of what passes to and
// fro; negative: the wall gives energy away.
bool is_passive(const SampledDevice& device, double K, double B);

// By bisection to one part in 10^5; 0 where there is none.
double max_stable_stiffness(const SampledDevice& device, double B);
double max_passive_stiffness(const SampledDevice& device, double B);
double max_passive_damping(const SampledDevice& device, double K);

}  // namespace twinarm
