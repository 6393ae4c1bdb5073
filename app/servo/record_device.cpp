#include "app/servo/record_device.h"

#include <cmath>

#include "app/servo/servo_clock.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

// The first state of a device that is there.
DeviceState first_state(HandDevice& device, ServoClock& clock, bool real_time, double h) {
  constexpr double kPatience = 5;  // [s]
  for (double waited = 0;; waited += h) {
    const DeviceState state = device.poll(0);
    if (state.alive) return state;
    if (waited > kPatience)
      throw InputError({{"", 0, "--device", device.description() + " says nothing",
                         "see that it is switched on and not in use elsewhere", "device.silent"}});
    if (real_time) clock.wait();
  }
}

}  // namespace

std::unique_ptr<LiveHand> record_hand(HandDevice& device, double duration, bool real_time,
                                      const std::function<void(double)>& tick) {
  const double h = 1 / device.figures().rate;
  const auto steps = static_cast<std::size_t>(std::ceil(duration / h - 1e-9));
  auto hand = std::make_unique<LiveHand>(steps);
  ServoClock clock(h);
  clock.start();
  DeviceState last = first_state(device, clock, real_time, h);
  for (std::size_t n = 0; n < steps; ++n) {
    const double t = static_cast<double>(n) * h;
    if (real_time) clock.wait();
    DeviceState now = device.poll(t);
    if (!now.alive) now = last;
    HandStep step{t, h, {}};
    step.hand.theta = now.theta;
    for (std::size_t j = 0; j < now.theta.size(); ++j)
      step.hand.theta_dot[j] = (now.theta[j] - last.theta[j]) / h;
    step.hand.button = now.buttons[0];
    hand->set(step);
    device.render({});
    last = now;
    tick(t + h);
  }
  return hand;
}

}  // namespace twinarm
