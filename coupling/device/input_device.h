// A hand device: what it says of the hand, and what it lets the hand feel.
//
// poll() and render() are called once a tick by one thread, neither waits, throws nor allocates.
// Whatever has to wait (a socket, an event queue) runs elsewhere and leaves its newest state.
#pragma once

#include <array>
#include <string>

#include "coupling/device/omni.h"

namespace twinarm {

struct DeviceState {
  double t = 0;                   // when it was sensed, on the clock of now() below [s]
  OmniAngles theta{};             // [rad]; theta3 relative to theta2
  Pose stylus;                    // device axes [m]
  std::array<bool, 2> buttons{};  // the first closes the gripper, the second is the clutch
  bool alive = true;              // false: nothing has come for too long; the rest is old
};

// Torques of the three motors [N m]: J^T of a force at the stylus, or what the mapping gives.
struct DeviceForce {
  std::array<double, 3> torque{};
};

class HandDevice {
 public:
  virtual ~HandDevice() = default;
  // `now` [s] is the tick's time: of the run where time is simulated, of the clock where it is not.
  virtual DeviceState poll(double now) noexcept = 0;
  // Until the next call (a zero-order hold). The device limits it to what its motors can do.
  virtual void render(const DeviceForce& force) noexcept = 0;
  virtual const OmniParameters& figures() const = 0;
  virtual std::string description() const = 0;  // one line for reports
  // What of the force can be felt: false for what has no motors (a trace, a keyboard).
  virtual bool has_motors() const = 0;
};

}  // namespace twinarm
