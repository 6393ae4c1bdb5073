// Device of a VRPN server, for instance vrpn_Phantom: poses and buttons in, forces out.
//
// One thread exchanges messages with the server, and the newest report and force with poll() and
// render() without a lock (coupling/device/triple_buffer.h). poll() and render() never block.
//
// Reports come at 60 Hz to 1 kHz. Steps of that size would cause impacts in a relative damper, so
// the angles move linearly to each report within the time between reports (running mean): delayed
// by one report, continuous, with the mean speed between reports. There is no extrapolation.
//
// The server sends the stylus' pose [m] in device axes; the joint angles follow by inverse
// kinematics, and stay for a pose out of reach. The force is sent as a constant force field about
// the stylus, F = J^-T tau, limited to the device's peak force; it ends `force_timeout` after the
// last render().
//
// After `silence` without a report `alive` is false. A connection that breaks, sends invalid data
// or no pose for `timeout` is closed and retried at increasing intervals. Each kind of trouble is
// reported once, and counted.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "coupling/device/input_device.h"

namespace twinarm {

struct VrpnAddress {
  std::string device, host;
  int port = 3883;
};

struct VrpnSettings {
  double silence = 0.1;                          // [s]
  double timeout = 3;                            // [s]
  double first_retry = 0.1, longest_retry = 2;   // [s]
  double force_timeout = 0.1;                    // [s]
  double rate = 1000;                            // requested from the server [Hz]
  std::function<void(const std::string&)> warn;  // gets one line; empty: stderr
};

struct VrpnCounts {
  long connections = 0;  // with a valid handshake
  long poses = 0;
  long not_finite = 0, malformed = 0, out_of_reach = 0;  // skipped
  long broken = 0;                                       // connections lost, refused or closed
};

class VrpnDevice final : public InputDevice {
 public:
  // Waits for the first pose, at most twice `timeout`. Throws InputError: unknown host, connection
  // refused, not a VRPN server, unknown device.
  VrpnDevice(const VrpnAddress& address, const OmniParameters& parameters,
             const VrpnSettings& settings = {});
  ~VrpnDevice() override;  // ends the force
  DeviceState poll(double now) noexcept override;
  void render(const DeviceForce& force) noexcept override;
  const OmniParameters& parameters() const override { return parameters_; }
  std::string description() const override { return description_; }
  bool has_motors() const override;  // whether the server accepts forces
  VrpnCounts counts() const;

 private:
  class Link;
  std::unique_ptr<Link> link_;
  OmniParameters parameters_;
  std::string description_;
  double silence_;
  // Motion from one report to the next.
  OmniAngles from_{}, to_{}, at_{};
  double start_ = 0, interval_ = 0;  // [s]
  long seen_ = 0;                    // number of the report at its end
  long rendered_ = 0;                // number of the newest force
};

}  // namespace twinarm
