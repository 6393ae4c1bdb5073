#include "app/device/gesture_device.h"
#include "app/support/seconds.h"

#include <poll.h>
#include <sys/eventfd.h>

#include <cerrno>
#include <chrono>

namespace twinarm {
namespace {

constexpr int kGestureTick = 20;   // keys that are not held any more are noticed [ms]
constexpr int kGestureLook = 500;  // for a device that is gone [ms]

}  // namespace

GestureDevice::GestureDevice(GestureSource source, const VirtualOmniSettings& settings)
    : source_(std::move(source)),
      hand_(std::make_shared<GestureHand>(settings.figures)),
      omni_(hand_, settings),
      stop_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      thread_([this] { run(); }) {}

GestureDevice::~GestureDevice() {
  const std::uint64_t one = 1;
  while (write(stop_.get(), &one, sizeof one) < 0 && errno == EINTR) {
  }
  thread_.join();
}

DeviceState GestureDevice::poll(double now) noexcept {
  DeviceState state = omni_.poll(now);
  state.alive = connected_;
  return state;
}

void GestureDevice::run() {
  pollfd ready[2] = {{stop_.get(), POLLIN, 0}, {source_.fd.get(), POLLIN, 0}};
  while (ready[0].revents == 0) {
    ready[0].revents = ready[1].revents = 0;
    ready[1].fd = source_.fd.get();  // a negative one is passed over
    ::poll(ready, 2, connected_ ? kGestureTick : kGestureLook);
    if (connected_ && ready[1].revents != 0 && !read_some()) {
      connected_ = false;
      hand_->release();
      source_.decoder->forget();
      source_.fd = OwnedFd();
    } else if (!connected_ && source_.again && ready[0].revents == 0) {
      source_.fd = source_.again();
      connected_ = source_.fd.get() >= 0;
    }
    if (connected_) source_.decoder->pass(steady_seconds(), *hand_);
  }
}

// False: the device is gone.
bool GestureDevice::read_some() {
  std::array<std::uint8_t, 512> bytes{};
  const auto count = read(source_.fd.get(), bytes.data(), bytes.size());
  if (count > 0)
    source_.decoder->feed(bytes.data(), static_cast<std::size_t>(count), steady_seconds(), *hand_);
  return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
}

}  // namespace twinarm
