// Interface of an input device, with or without force feedback.
//
// poll() and render() are called once a tick by one thread; they do not wait, throw or allocate.
// Input and output (socket, event queue) run in other threads.
#pragma once

#include <array>
#include <string>

#include "coupling/device/omni.h"

namespace twinarm {

struct DeviceState {
  double t = 0;                   // time of the measurement, on the clock of poll() [s]
  OmniAngles theta{};             // [rad]; theta3 relative to theta2
  Pose stylus;                    // device axes [m]
  std::array<bool, 2> buttons{};  // gripper, clutch
  bool alive = true;              // false: no data for too long
};

// Torques of the three motors [N m].
struct DeviceForce {
  std::array<double, 3> torque{};
};

class InputDevice {
 public:
  virtual ~InputDevice() = default;
  // `now`: time of the tick [s], simulated or of the clock.
  virtual DeviceState poll(double now) noexcept = 0;
  // Force until the next call (zero-order hold), limited by the device.
  virtual void render(const DeviceForce& force) noexcept = 0;
  virtual const OmniParameters& parameters() const = 0;
  virtual std::string description() const = 0;  // one line
  // False for devices without force feedback (trace, keyboard).
  virtual bool has_motors() const = 0;
};

}  // namespace twinarm
