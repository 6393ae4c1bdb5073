// Passivity observer and controller of what a hand feels (Hannaford and Ryu 2002), with the work
// that the held force really does (Ryu, Kim and Hannaford 2004; docs/hand_force.md):
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
      : most_(one_ticks_work), lowest_(-one_ticks_work), stiffest_(stiffest) {}

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
  double most_, lowest_;  // W, and the lowest that E has been, -W at most
  double stiffest_;
  double E_ = 0;
  bool placed_ = false;
  Vector3 x_ = Vector3::Zero(), d_ = Vector3::Zero(), held_ = Vector3::Zero();
};

}  // namespace twinarm
