// What a device does for a while: its angles at each tick, as a hand that can be played again.
#pragma once

#include <functional>
#include <memory>

#include "coupling/device/device_motion.h"
#include "coupling/device/input_device.h"

namespace twinarm {

// At the device's own rate, for so many seconds. In real time, or as fast as it goes for a device
// that is simulated. Rates are differences; a device that is silent stands. No force is rendered.
// `tick` is called with the time that has gone, and may throw. Throws InputError for a device that
// says nothing in its first five seconds.
std::unique_ptr<LiveHand> record_hand(HandDevice& device, double duration, bool real_time,
                                      const std::function<void(double)>& tick);

}  // namespace twinarm
