// A haptic device against a virtual wall, tick by tick: which walls are stable, and which give no
// energy away. One direction; the wall pulls as well as it pushes (docs/hand_force.md).
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
#pragma once

namespace twinarm {

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
double largest_stable_stiffness(const SampledDevice& device, double B);
double largest_passive_stiffness(const SampledDevice& device, double B);
double largest_passive_damping(const SampledDevice& device, double K);

}  // namespace twinarm
