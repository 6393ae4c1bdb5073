// Watchdog of an input device (device timeout: `DeviceState::alive`; VRPN 0.1 s:
// app/device/vrpn_client.h). Without data the target robot stops, then releases the couplings; when
// the device is back it continues without a jump.
//
//   live      the device moves the target robot
//   held      no data for less than kTimeout: the target stays
//   released  no data for longer: the target relaxes to the robot, d(q_K - q_D)/dt = -(q_K -
//   q_D)/kSlack
#pragma once

#include <cmath>
#include <cstddef>

#include "coupling/device/device_mapping.h"

namespace twinarm {

class DeviceWatchdog {
 public:
  enum class Mode { live, held, released };

  // One tick of h [s]. Updates `target`; q_D: driven joints of the DVR.
  void tick(const DeviceState& device, DeviceMapping& mapping, const std::vector<double>& q_D,
            double h, MappedTarget& target) noexcept {
    if (device.alive) {
      if (mode_ != Mode::live) mapping.begin(device, target.q);  // no jump
      mode_ = Mode::live;
      silent_ = 0;
      target = mapping.map(device, h);
      return;
    }
    if (mode_ == Mode::live) ++silences_;
    silent_ += h;
    mode_ = silent_ < kTimeout ? Mode::held : Mode::released;
    const double left = std::exp(-h / kSlack);
    for (std::size_t j = 0; j < target.q.size(); ++j) {
      target.qd[j] = 0;
      if (mode_ == Mode::released) target.q[j] = q_D[j] + left * (target.q[j] - q_D[j]);
    }
  }
  Mode mode() const { return mode_; }
  long silences() const { return silences_; }

 private:
  static constexpr double kTimeout = 1.0, kSlack = 0.2;  // [s]
  double silent_ = 0;
  Mode mode_ = Mode::live;
  long silences_ = 0;
};

}  // namespace twinarm
