#include "app/device/gesture_device.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/joystick.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "app/device/devices.h"
#include "app/support/files.h"
#include "app/support/progress.h"

namespace twinarm {
namespace {

constexpr int kGestureTick = 20;   // for the release of keys [ms]
constexpr int kReopenEvery = 500;  // [ms]

OwnedFd open_to_read(const std::string& path) {
  return OwnedFd(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
}

std::string first_joystick() {
  for (int n = 0; n < 32; ++n) {
    const std::string path = fmt::format("/dev/input/js{}", n);
    if (std::filesystem::exists(path)) return path;
  }
  return "/dev/input/js0";
}

OwnedFd open_socket(const std::string& path) {
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  if (path.size() >= sizeof name.sun_path) {
    errno = ENAMETOOLONG;
    return OwnedFd();
  }
  std::memcpy(name.sun_path, path.c_str(), path.size() + 1);
  OwnedFd fd(socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (connect(fd.get(), reinterpret_cast<const sockaddr*>(&name), sizeof name) != 0)
    return OwnedFd();
  return fd;
}

}  // namespace

GestureDevice::GestureDevice(GestureSource source, const VirtualOmniSettings& settings)
    : source_(std::move(source)),
      input_(std::make_shared<DesktopInput>(settings.parameters)),
      omni_(input_, settings),
      stop_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      thread_([this] {
        try {
          run();
        } catch (const std::exception& error) {
          connected_ = false;
          print_error("twinarm: {}: {}\n", description(), error.what());
        }
      }) {}

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
    ready[1].fd = source_.fd.get();  // poll() ignores a negative one
    ::poll(ready, 2, connected_ ? kGestureTick : kReopenEvery);
    if (connected_ && ready[1].revents != 0 && !read_some()) {
      connected_ = false;
      input_->release();
      source_.decoder->forget();
      source_.fd = OwnedFd();
    } else if (!connected_ && source_.reopen && ready[0].revents == 0) {
      source_.fd = source_.reopen();
      connected_ = source_.fd.get() >= 0;
    }
    if (connected_) source_.decoder->pass(steady_seconds(), *input_);
  }
}

// False: disconnected.
bool GestureDevice::read_some() {
  std::array<std::uint8_t, 512> bytes{};
  const auto count = read(source_.fd.get(), bytes.data(), bytes.size());
  if (count > 0)
    source_.decoder->feed(bytes.data(), static_cast<std::size_t>(count), steady_seconds(), *input_);
  return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
}

// No library: SDL requires libGL, which conflicts with OSMesa; libspnav requires X11.

GestureSource open_keyboard(const std::string& path) {
  const std::string terminal = path.empty() ? "/dev/tty" : path;
  OwnedFd fd = open_to_read(terminal);
  if (fd.get() < 0)
    refuse_spec("keyboard", fmt::format("{}: {}", terminal, std::strerror(errno)),
                "run it in a terminal, not in a service or a pipe");
  auto mode = std::make_shared<RawTerminal>(fd.get());
  if (!mode->is_terminal())
    refuse_spec(
        "keyboard",
        fmt::format("{} is not a terminal, or is already in use as a keyboard device", terminal),
        "run it in a terminal, with one keyboard device");
  return {"keyboard (arrows, w s, a d, r f, q e; space: gripper, c: clutch, x: stop)",
          std::make_unique<KeyDecoder>(), std::move(fd), nullptr, mode};
}

GestureSource open_gamepad(const std::string& path) {
  const std::string file = path.empty() ? first_joystick() : path;
  OwnedFd fd = open_to_read(file);
  const int error = errno;
  if (fd.get() < 0)
    refuse_spec("gamepad", fmt::format("{}: {}", file, std::strerror(error)),
                error == EACCES ? "log in locally, or join the group 'input'"
                                : "connect the controller, and load the kernel module 'joydev'");
  std::array<char, 128> name{};
  std::array<std::uint8_t, 64> codes{};
  std::uint8_t axes = 0;
  const bool is_joystick = ioctl(fd.get(), JSIOCGAXES, &axes) >= 0 &&
                           ioctl(fd.get(), JSIOCGAXMAP, codes.data()) >= 0 && axes <= codes.size();
  if (!is_joystick) axes = 0;
  if (ioctl(fd.get(), JSIOCGNAME(name.size() - 1), name.data()) < 0) name[0] = '\0';
  return {fmt::format("game controller {} at {}", name.data(), file),
          std::make_unique<JoystickDecoder>(
              std::vector<std::uint8_t>(codes.begin(), codes.begin() + axes)),
          std::move(fd), [file] { return open_to_read(file); }, nullptr};
}

GestureSource open_space_mouse(const std::string& path) {
  const char* named = std::getenv("SPNAV_SOCKET");  // spacenavd's own variable
  const std::string file = !path.empty() ? path : named ? named : "/var/run/spnav.sock";
  OwnedFd fd = open_socket(file);
  if (fd.get() < 0)
    refuse_spec("spacemouse",
                fmt::format("spacenavd does not answer at {}: {}", file, std::strerror(errno)),
                "install and start it: scripts/setup --hand; systemctl start spacenavd");
  return {fmt::format("space mouse by spacenavd at {}", file),
          std::make_unique<SpaceMouseDecoder>(), std::move(fd),
          [file] { return open_socket(file); }, nullptr};
}

}  // namespace twinarm
