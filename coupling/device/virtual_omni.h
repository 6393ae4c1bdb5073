// The Phantom Omni in software: a point mass at the stylus between a person's arm and three motors.
//
// With x the stylus' point, g the place where the hand wants it, F the motors' force at the point:
//
//   (m_device + m_arm) x'' = k (g - x) + b (g' - x') - b_device x' + F - friction
//
//   friction  Coulomb's, opposite to the motion, at most `friction` in any direction; at rest it is
//             what holds the point, up to that: a true stick, not one bit of creep
//   motors    torques held from tick to tick, limited so that the force at the stylus is at most
//             peak_force (omni_limit)
//   encoders  theta1..theta6 in counts of resolution / L1 [rad]: one count of the waist moves the
//             point by `resolution` at the distance L1, one of the elbow at L2
//   stops     the ranges of theta1..theta3: the point goes no further than the nearest place within
//             them, and loses its velocity against them
//   gimbal    theta4..theta6 have no motors: they are the hand's, within their ranges
//
// Time is the device's own grid of ticks, 1 / rate apart, from the first poll on. A force that is
// rendered after poll(t) acts from the first tick at t or later (+ delay_to_motors); a poll shows
// the last tick at or before its time (- delay_to_host). Between ticks the linear part is advanced
// by its exact exponential, so no stiffness of the arm is too large, and friction by the constant
// force that stops or slows the point. What the mass of a real Omni does besides (it differs by
// direction and posture) is not in it. docs/understand/phantom_omni.md. Cost: about
// 2 us of processor time a tick.
#pragma once

#include <memory>
#include <vector>

#include "coupling/device/input_device.h"
#include "coupling/target/operator_motion.h"

namespace twinarm {

// The arm of a person who holds the stylus. Assumed; docs/understand/phantom_omni.md has measured ones. All zero: a
// device that nobody holds.
struct ArmImpedance {
  double stiffness = 300;  // [N/m]
  double damping = 5;      // [N s/m], against the motion that is wanted
  double mass = 0.1;       // of the fingers, moved with the stylus [kg]
};

struct VirtualOmniSettings {
  OmniParameters figures;
  ArmImpedance arm;
  double device_damping = 0;                      // of the device itself [N s/m]
  double delay_to_host = 0, delay_to_motors = 0;  // [s]
};

class VirtualOmni final : public HandDevice {
 public:
  // Starts at rest where the hand is at its time 0. The hand is asked once a tick, by the thread
  // that polls. Throws InputError with all faults of the settings.
  VirtualOmni(std::shared_ptr<const OperatorMotion> hand, const VirtualOmniSettings& settings);

  DeviceState poll(double now) noexcept override;
  void render(const DeviceForce& force) noexcept override;
  const OmniParameters& figures() const override { return figures_; }
  std::string description() const override;
  bool has_motors() const override { return true; }

  // What no host of a real device can know; of the last tick, device axes.
  struct Truth {
    OmniAngles theta{};
    Vector3 position = Vector3::Zero(), velocity = Vector3::Zero();
    Vector3 goal = Vector3::Zero();    // where the hand wants the point
    Vector3 motors = Vector3::Zero();  // their force on the stylus, before this instant [N]
    bool sticks = false;
  };
  const Truth& truth() const { return truth_; }

 private:
  struct Rendered {
    long tick = -1;  // from which it acts
    std::array<double, 3> torque{};
  };
  // Over one substep: position and velocity from position, velocity and a constant force.
  struct Response {
    double xx, xv, xf, vx, vv, vf;
  };

  void tick() noexcept;
  void substep(const Vector3& goal, const Vector3& goal_velocity) noexcept;
  void stop_at_ranges() noexcept;
  void look_at_hand() noexcept;
  void sense() noexcept;

  std::shared_ptr<const OperatorMotion> hand_;
  OmniParameters figures_;
  double viscous_, period_, delay_to_host_, delay_to_motors_;
  Response response_;
  HandSample wanted_;  // at the last tick
  Truth truth_;
  std::vector<DeviceState> sensed_;  // of the last ticks, by tick
  std::vector<Rendered> rendered_;   // of the next ticks, by tick
  std::array<double, 3> held_{};
  long tick_ = 0;
  double origin_ = 0, now_ = 0;  // on the host's clock: of tick 0, of the last poll
  bool polled_ = false;
};

}  // namespace twinarm
