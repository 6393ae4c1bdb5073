// A hand device behind a VRPN server, for instance vrpn_Phantom: poses and buttons in, forces out.
//
// One thread talks to the server; it leaves the newest report, and takes the newest force, without
// a lock (coupling/device/triple_buffer.h). poll() and render() never wait.
//
// Reports come at 60 Hz to 1 kHz, a staircase that a relative damper would feel as blows. So from
// each report on the angles go evenly from where they are to what it says, in the time that lies
// between reports (their running mean): one report late, without a jump of the angles, and the
// speed is that between reports. Nothing is extrapolated: what is not renewed stands still.
//
// The server tells the stylus' POSE, in metres, in the device's axes; the joint angles follow by
// inverse kinematics. A pose out of reach leaves the angles where they are. The force goes out as
// a constant force field about the stylus, F = J^-T tau, at most the device's peak force, and ends
// when render() has not been called for `let_go`.
//
// A silence longer than `silence` makes `alive` false. A connection that breaks, talks garbage or
// gives no pose for `patience` is given up and made anew, at ever longer intervals. Each kind of
// trouble is said once, and counted.
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
  double silence = 0.1;                         // [s]
  double patience = 3;                          // [s]
  double first_retry = 0.1, longest_retry = 2;  // [s]
  double let_go = 0.1;                          // [s]
  double rate = 1000;                           // asked of the server [Hz]
  std::function<void(const std::string&)> say;  // one line; empty: to stderr
};

struct VrpnCounts {
  long connections = 0;  // that greeted us properly
  long poses = 0;
  long not_finite = 0, malformed = 0, out_of_reach = 0;  // skipped
  long broken = 0;                                       // connections lost, refused or given up
};

class VrpnDevice final : public HandDevice {
 public:
  // Waits for the first pose, at most twice `patience`. Throws InputError, with a remedy, where the
  // host is not known, refuses, is not a VRPN server, or has no such device.
  VrpnDevice(const VrpnAddress& address, const OmniParameters& figures,
             const VrpnSettings& settings = {});
  ~VrpnDevice() override;  // ends the force
  DeviceState poll(double now) noexcept override;
  void render(const DeviceForce& force) noexcept override;
  const OmniParameters& figures() const override { return figures_; }
  std::string description() const override { return description_; }
  bool has_motors() const override;  // the server takes forces for it
  VrpnCounts counts() const;

 private:
  class Link;
  std::unique_ptr<Link> link_;
  OmniParameters figures_;
  std::string description_;
  double silence_;
  // The way from one report to the next.
  OmniAngles from_{}, to_{}, at_{};
  double start_ = 0, interval_ = 0;  // [s]
  long seen_ = 0;                    // number of the report that it leads to
  long rendered_ = 0;                // number of the newest force
};

}  // namespace twinarm
