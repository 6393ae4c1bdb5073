// Simulated Phantom Omni: a point mass at the stylus between the operator's arm and three motors.
//
// With x the stylus' point, g the operator's goal, F the motors' force at the point:
//
//   (m_device + m_arm) x'' = k (g - x) + b (g' - x') - b_device x' + F - friction
//
//   friction  Coulomb friction, at most `friction`; exact sticking without creep
//   motors    torques held from tick to tick, limited so that the force at the stylus is at most
//             peak_force (omni_limit)
//   encoders  theta1..theta3 in counts of resolution / L1 [rad]
//   stops     ranges of theta1..theta3: nearest point within them, inelastic
//   gimbal    theta4..theta6 have no motors: the operator's angles, within their ranges
//
// Time is a grid of ticks of 1 / rate from the first poll on. A force rendered after poll(t) acts
// from the first tick at t or later (+ delay_to_motors); a poll returns the last tick at or before
// its time (- delay_to_host). Between ticks the linear part is integrated exactly, so any stiffness
// of the arm is stable, and friction as a constant force. Not modelled: the dependence of a real
// Omni's apparent mass on direction and posture (docs/understand/phantom_omni.md). Cost: about 2 us
// per tick.
#pragma once

#include <memory>
#include <vector>

#include "coupling/device/input_device.h"
#include "coupling/target/operator_motion.h"

namespace twinarm {

// Impedance of the operator's arm. Assumed; measured values: docs/understand/phantom_omni.md. All
// zero: a free device.
struct ArmImpedance {
  double stiffness = 300;  // [N/m]
  double damping = 5;      // relative to the goal's velocity [N s/m]
  double mass = 0.1;       // of the fingers, added to the stylus [kg]
};

struct VirtualOmniSettings {
  OmniParameters parameters;
  ArmImpedance arm;
  double device_damping = 0;                      // of the device [N s/m]
  double delay_to_host = 0, delay_to_motors = 0;  // [s]
};

class VirtualOmni final : public InputDevice {
 public:
  // Starts at rest at the motion's pose at t = 0. Samples the motion once a tick, in the polling
  // thread. Throws InputError with all errors of the settings.
  VirtualOmni(std::shared_ptr<const OperatorMotion> motion, const VirtualOmniSettings& settings);

  DeviceState poll(double now) noexcept override;
  void render(const DeviceForce& force) noexcept override;
  const OmniParameters& parameters() const override { return parameters_; }
  std::string description() const override {
    return "virtual Phantom Omni, moved by: " + motion_->description();
  }
  bool has_motors() const override { return true; }

  // State that a real device does not reveal; at the last tick, device axes.
  struct Truth {
    OmniAngles theta{};
    Vector3 position = Vector3::Zero(), velocity = Vector3::Zero();
    Vector3 goal = Vector3::Zero();    // of the operator
    Vector3 motors = Vector3::Zero();  // their force on the stylus in the last substep [N]
    bool sticks = false;
  };
  const Truth& truth() const { return truth_; }

 private:
  struct Rendered {
    long tick = -1;  // first tick at which it acts
    std::array<double, 3> torque{};
  };
  // State transition over one substep: position and velocity from position, velocity and a constant
  // force.
  struct Response {
    double xx, xv, xf, vx, vv, vf;
  };

  void tick() noexcept;
  void substep(const Vector3& goal, const Vector3& goal_velocity) noexcept;
  void stop_at_ranges() noexcept;
  void update_angles() noexcept;
  void sense() noexcept;

  std::shared_ptr<const OperatorMotion> motion_;
  OmniParameters parameters_;
  double viscous_, period_, delay_to_host_, delay_to_motors_;
  Response response_;
  OperatorSample wanted_;  // at the last tick
  Truth truth_;
  std::vector<DeviceState> sensed_;  // of the last ticks, by tick
  std::vector<Rendered> rendered_;   // of the next ticks, by tick
  std::array<double, 3> held_{};
  long tick_ = 0;
  double origin_ = 0, now_ = 0;  // on the host's clock: of tick 0, of the last poll
  bool polled_ = false;
};

}  // namespace twinarm
