// Keyboard, game controller and space mouse with a pseudo-terminal, a named pipe and a socket.
// Bytes are written by hand from the formats of the terminal, linux/joystick.h and spacenavd.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <termios.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <random>
#include <thread>

#include "app/device/devices.h"
#include "app/device/file_descriptors.h"
#include "app/device/gesture_device.h"
#include "solver/support/diagnostics.h"

using namespace twinarm;

namespace {

// Displacement of the stylus [m] and of the gimbal [rad] by a decoder's bytes in a tenth of a
// second.
struct Moved {
  Vector3 place;
  std::array<double, 3> gimbal;
  Vector3 rotation;  // of the stylus, rotation vector [rad]
};
Moved moved_by(GestureDecoder& decoder, const std::vector<std::uint8_t>& bytes) {
  const OmniParameters omni;
  DesktopInput hand(omni);
  const OmniAngles before = hand.sample(0, 1).theta;
  decoder.feed(bytes.data(), bytes.size(), 0, hand);
  const OmniAngles after = hand.sample(0.1, 1).theta;
  const Eigen::AngleAxisd turn(omni_stylus(omni, after).R *
                               omni_stylus(omni, before).R.transpose());
  return {omni_position(omni, after) - omni_position(omni, before),
          {after[3] - before[3], after[4] - before[4], after[5] - before[5]},
          turn.angle() * turn.axis()};
}
std::vector<std::uint8_t> letters(const std::string& text) {
  return {text.begin(), text.end()};
}
// time, value, type, number; little-endian.
std::vector<std::uint8_t> joystick(int value, std::uint8_t type, std::uint8_t number) {
  const auto byte = [](int bits) { return static_cast<std::uint8_t>(bits & 0xff); };
  return {0x10, 0x27, 0, 0, byte(value), byte(value >> 8), type, number};
}
std::vector<std::uint8_t> space_mouse(const std::array<std::int32_t, 8>& words) {
  std::vector<std::uint8_t> bytes(32);
  std::memcpy(bytes.data(), words.data(), 32);
  return bytes;
}
void check_goes(const Moved& moved, const Vector3& direction, double metres) {
  CHECK((moved.place - metres * direction).norm() < 1e-9);
}
const Vector3 kRight = Vector3::UnitX(), kUp = Vector3::UnitY(), kToward = Vector3::UnitZ();

std::string scratch(const char* name) {
  return (std::filesystem::temp_directory_path() / (name + std::to_string(getpid()))).string();
}
// Polls a device in real time.
DeviceState run_for(InputDevice& device, double seconds) {
  const auto clock = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  };
  DeviceState state = device.poll(clock());
  for (const double end = clock() + seconds; clock() < end;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    state = device.poll(clock());
  }
  return state;
}

}  // namespace

TEST_CASE(
    "keys: each moves the stylus in its direction at 0.1 m/s, also with split escape sequences") {
  const struct {
    const char* bytes;
    Vector3 direction;
  } keys[] = {{"\x1b[C", kRight},       {"\x1b[D", -kRight},    {"\x1b[A", kUp},
              {"\x1bOA", kUp},          {"\x1b[B", -kUp},       {"s", kToward},
              {"w", -kToward},          {"W", -kToward},        {"\x1b[1;2C", kRight},
              {"\x1b[D\x1b[C", kRight}, {"\x1b[15~w", -kToward}};
  for (const auto& key : keys) {
    CAPTURE(std::string(key.bytes));
    KeyDecoder whole;
    check_goes(moved_by(whole, letters(key.bytes)), key.direction, 0.01);
  }
  KeyDecoder turns;
  CHECK(moved_by(turns, letters("d")).gimbal[0] == doctest::Approx(0.15));
  KeyDecoder nothing;
  check_goes(moved_by(nothing, letters("\x1b[Cx")), kRight, 0);
}

TEST_CASE("keys: a key that is not repeated is released after the hold time; buttons toggle") {
  KeyDecoder decoder(0.2);
  DesktopInput hand{OmniParameters()};
  const std::uint8_t key = 'd', space = ' ', clutch = 'c';
  const double start = hand.sample(0, 1).theta[3];
  decoder.feed(&key, 1, 10.0, hand);
  decoder.pass(10.1, hand);
  const double held = hand.sample(0.1, 1).theta[3];
  CHECK(held > start);
  decoder.pass(10.3, hand);
  const double released = hand.sample(0.2, 1).theta[3];
  CHECK(hand.sample(0.3, 1).theta[3] == released);
  decoder.feed(&space, 1, 11, hand);
  CHECK(hand.sample(0.3, 1).button);
  decoder.feed(&space, 1, 11, hand);
  CHECK_FALSE(hand.sample(0.3, 1).button);
  decoder.feed(&clutch, 1, 11, hand);
  CHECK(hand.sample(0.3, 1).clutch);
}

TEST_CASE("game controller: sticks move the stylus, also without an RX axis") {
  const auto axis = [](int value, std::uint8_t number) { return joystick(value, 0x02, number); };
  const auto check = [&](std::vector<std::uint8_t> codes, int value, std::uint8_t number,
                         const Vector3& direction) {
    JoystickDecoder decoder(std::move(codes));
    check_goes(moved_by(decoder, axis(value, number)), direction, 0.01);
  };
  check({}, 32767, 0, kRight);
  check({}, -32767, 1, kUp);  // the kernel's y goes down
  check({}, 32767, 4, kToward);
  check({0, 1, 2, 5}, 32767, 3, kToward);  // ABS_X, Y, Z, RZ
  check({}, -32768, 0, -kRight);           // one beyond the full range
  JoystickDecoder initial;
  check_goes(moved_by(initial, joystick(32767, 0x82, 0)), kRight, 0.01);  // initial value
  JoystickDecoder half;
  const double part = moved_by(half, axis(16384, 0)).place.x();
  CHECK(part > 0.003);  // between the dead zone and full
  CHECK(part < 0.006);
  JoystickDecoder resting;
  check_goes(moved_by(resting, axis(1000, 0)), kRight, 0);  // in the dead zone
  JoystickDecoder triggers;                                 // at rest both are at -1: no roll
  std::vector<std::uint8_t> both = axis(-32767, 2);
  const auto right = axis(-32767, 5);
  both.insert(both.end(), right.begin(), right.end());
  CHECK(moved_by(triggers, both).gimbal[2] == 0);
}

TEST_CASE("game controller: buttons; invalid axis and button numbers are ignored") {
  JoystickDecoder decoder;
  DesktopInput hand{OmniParameters()};
  const auto feed = [&](const std::vector<std::uint8_t>& bytes) {
    for (const std::uint8_t byte : bytes) decoder.feed(&byte, 1, 0, hand);  // split
  };
  feed(joystick(1, 0x81, 0));
  CHECK(hand.sample(0, 1).button);
  feed(joystick(1, 0x01, 1));
  CHECK(hand.sample(0, 1).clutch);
  feed(joystick(0, 0x01, 0));
  CHECK_FALSE(hand.sample(0, 1).button);
  const OmniAngles before = hand.sample(0, 1).theta;
  feed(joystick(32767, 0x02, 200));
  feed(joystick(1, 0x01, 77));
  feed(joystick(32767, 0x7f, 0));
  CHECK(hand.sample(0.1, 1).theta == before);
}

TEST_CASE("space mouse: six axes and two buttons; z points away from the user, with its rotation") {
  const auto push = [](std::size_t n, int value) {
    std::array<std::int32_t, 8> words{};
    words[n] = value;
    return space_mouse(words);
  };
  const auto check = [&](std::size_t n, const Vector3& direction) {
    SpaceMouseDecoder decoder;
    check_goes(moved_by(decoder, push(n, 350)), direction, 0.01);
  };
  check(1, kRight);
  check(2, kUp);
  check(3, -kToward);
  const auto turned = [&](std::size_t n) {
    SpaceMouseDecoder decoder;
    return moved_by(decoder, push(n, 350)).rotation;
  };
  CHECK(turned(4).x() > 0.1);
  CHECK(turned(5).y() > 0.05);
  CHECK(turned(6).z() < -0.01);  // about the stylus, nearly vertical
  SpaceMouseDecoder damaged;
  check_goes(moved_by(damaged, space_mouse({99, 350, 350, 350, 0, 0, 0, 0})), kRight, 0);
  SpaceMouseDecoder decoder;
  DesktopInput hand{OmniParameters()};
  const auto press = space_mouse({1, 1, 0, 0, 0, 0, 0, 0});
  decoder.feed(press.data(), press.size(), 0, hand);
  CHECK(hand.sample(0, 1).clutch);
}

TEST_CASE("desktop devices: random bytes give finite motions only") {
  std::mt19937 random(3);
  KeyDecoder keys;
  JoystickDecoder stick;
  SpaceMouseDecoder mouse;
  DesktopInput hand{OmniParameters()};
  for (int n = 0; n < 3000; ++n) {
    std::array<std::uint8_t, 40> bytes{};
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    for (GestureDecoder* decoder :
         {static_cast<GestureDecoder*>(&keys), static_cast<GestureDecoder*>(&stick),
          static_cast<GestureDecoder*>(&mouse)})
      decoder->feed(bytes.data(), 1 + random() % bytes.size(), 0.01 * n, hand);
    for (const double theta : hand.sample(0.01 * n, 1e9).theta) CHECK_UNARY(std::isfinite(theta));
  }
}

TEST_CASE(
    "keyboard: the terminal is raw while the device exists, restored afterwards, and moves it") {
  const OwnedFd master(posix_openpt(O_RDWR | O_NOCTTY));
  REQUIRE(grantpt(master.get()) == 0);
  REQUIRE(unlockpt(master.get()) == 0);
  const std::string terminal = ptsname(master.get());
  const OwnedFd keep(open(terminal.c_str(), O_RDWR | O_NOCTTY));
  const auto flags = [&] {
    termios mode{};
    tcgetattr(keep.get(), &mode);
    return mode.c_lflag & (ICANON | ECHO | ISIG);
  };
  CHECK(flags() == (ICANON | ECHO | ISIG));
  {
    const auto device = open_device("keyboard:" + terminal);
    CHECK(flags() == ISIG);  // Ctrl-C is still a signal
    CHECK_FALSE(device->has_motors());
    CHECK_THROWS_AS(open_device("keyboard:" + terminal), InputError);  // one at a time
    const DeviceState before = run_for(*device, 0.05);
    CHECK(before.alive);
    CHECK(write(master.get(), "\x1b[C ", 4) == 4);
    const DeviceState after = run_for(*device, 0.5);
    CHECK(after.stylus.p.x() > before.stylus.p.x() + 0.002);
    CHECK(after.buttons[0]);
  }
  CHECK(flags() == (ICANON | ECHO | ISIG));
}

TEST_CASE("keyboard: the terminal is restored when a signal ends the program") {
  const OwnedFd master(posix_openpt(O_RDWR | O_NOCTTY));
  REQUIRE(grantpt(master.get()) == 0);
  REQUIRE(unlockpt(master.get()) == 0);
  const OwnedFd terminal(open(ptsname(master.get()), O_RDWR | O_NOCTTY));
  for (const int ending : {SIGINT, SIGTERM}) {
    int ready_pipe[2];
    REQUIRE(pipe(ready_pipe) == 0);
    const pid_t child = fork();
    if (child == 0) {
      signal(ending, SIG_DFL);
      const RawTerminal raw(terminal.get());
      [[maybe_unused]] const auto done = write(ready_pipe[1], "r", 1);
      pause();
      _exit(0);
    }
    char ready = 0;
    REQUIRE(read(ready_pipe[0], &ready, 1) == 1);
    termios mode{};
    tcgetattr(terminal.get(), &mode);
    CHECK((mode.c_lflag & ICANON) == 0);
    kill(child, ending);
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == ending);
    tcgetattr(terminal.get(), &mode);
    CHECK((mode.c_lflag & (ICANON | ECHO)) == (ICANON | ECHO));
    close(ready_pipe[0]);
    close(ready_pipe[1]);
  }
}

TEST_CASE("game controller: unplugged it is not alive and at rest; reconnected it continues") {
  const std::string path = scratch("twinarm-js-");
  REQUIRE(mkfifo(path.c_str(), 0600) == 0);
  OwnedFd plug(open(path.c_str(), O_RDWR | O_CLOEXEC));
  const auto device = open_device("gamepad:" + path);
  const auto tilt = joystick(32767, 0x02, 0);
  CHECK(write(plug.get(), tilt.data(), tilt.size()) == 8);
  const DeviceState moving = run_for(*device, 0.3);
  CHECK(moving.alive);
  std::filesystem::remove(path);
  plug = OwnedFd();
  const DeviceState gone = run_for(*device, 0.5);
  CHECK_FALSE(gone.alive);
  CHECK((run_for(*device, 0.2).stylus.p - gone.stylus.p).norm() < 1e-3);
  REQUIRE(mkfifo(path.c_str(), 0600) == 0);
  plug = OwnedFd(open(path.c_str(), O_RDWR | O_CLOEXEC));
  bool alive = false;
  for (int n = 0; n < 20 && !alive; ++n) alive = run_for(*device, 0.1).alive;
  CHECK(alive);
  std::filesystem::remove(path);
}

TEST_CASE("space mouse: spacenavd's socket moves the device") {
  const std::string path = scratch("twinarm-spnav-");
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  std::strcpy(name.sun_path, path.c_str());
  const OwnedFd daemon(socket(AF_UNIX, SOCK_STREAM, 0));
  REQUIRE(bind(daemon.get(), reinterpret_cast<sockaddr*>(&name), sizeof name) == 0);
  REQUIRE(listen(daemon.get(), 1) == 0);
  const auto device = open_device("spacemouse:" + path);
  const OwnedFd client(accept(daemon.get(), nullptr, nullptr));
  const DeviceState before = run_for(*device, 0.05);
  const auto push = space_mouse({0, 0, 350, 0, 0, 0, 0, 16});
  CHECK(write(client.get(), push.data(), push.size()) == 32);
  CHECK(run_for(*device, 0.4).stylus.p.y() > before.stylus.p.y() + 0.005);
  std::filesystem::remove(path);
}
