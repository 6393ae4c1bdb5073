// Keyboard, game controller and space mouse as input devices: they move the operator of a virtual
// Omni. One thread reads the device; poll() and render() never block.
//
// An unplugged device sets `alive` to false and releases everything; reconnection is tried twice a
// second.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <thread>

#include "app/device/file_descriptors.h"
#include "coupling/device/desktop_input.h"
#include "coupling/device/virtual_omni.h"

namespace twinarm {

// Decodes the bytes of desktop input devices. Split packets are joined, invalid bytes are skipped.
// Device axes: x right, y up, z towards the user.

class GestureDecoder {
 public:
  virtual ~GestureDecoder() = default;
  // `now` [s]: any monotonic clock.
  virtual void feed(const std::uint8_t* bytes, std::size_t count, double now,
                    DesktopInput& input) = 0;
  virtual void pass(double /*now*/, DesktopInput& /*input*/) {}  // no bytes arrived
  virtual void forget() {}                                       // the device was disconnected
};

// Keys of a terminal. Terminals report presses and repetitions, no releases: a key counts as held
// until `hold` [s] after its last byte.
//   arrows  right, left, up, down       w s  away from the user, towards the user
//   a d     yaw                         r f  pitch                q e  roll
//   space   gripper on/off              c    clutch on/off        x    stop
class KeyDecoder final : public GestureDecoder {
 public:
  struct Key {
    char code;
    DeviceAxis axis;
    bool positive;
  };
  explicit KeyDecoder(double hold = 0.2) : hold_(hold) {}
  void feed(const std::uint8_t* bytes, std::size_t count, double now, DesktopInput& input) override;
  void pass(double now, DesktopInput& input) override;
  void forget() override;

 private:
  void letter(std::uint8_t byte, double now, DesktopInput& input);
  void press_key(std::span<const Key> keys, char code, double now, DesktopInput& input);
  void press(DeviceAxis axis, bool positive, double now, DesktopInput& input);
  void stop(std::size_t axis, std::size_t direction, DesktopInput& input);

  double hold_;
  enum class Escape { none, begun, sequence } escape_ = Escape::none;
  std::array<std::array<double, 2>, 6> until_{};  // by axis and direction; 0: not held
  std::array<bool, 2> buttons_{};
};

// Linux joystick events (linux/joystick.h, /dev/input/js*), 8 bytes each. Left stick: right, up.
// Right stick: towards the user, yaw. Triggers or D-pad: roll; D-pad: pitch. First button: gripper,
// second: clutch.
class JoystickDecoder final : public GestureDecoder {
 public:
  // Meaning of each axis from the kernel (ABS_X..); empty: the common layout.
  explicit JoystickDecoder(std::vector<std::uint8_t> axis_codes = {});
  void feed(const std::uint8_t* bytes, std::size_t count, double now, DesktopInput& input) override;
  void forget() override;

 private:
  void send_axes(DesktopInput& input) const;

  std::vector<std::uint8_t> codes_;
  bool has_right_stick_;            // on RX, RY; else on Z, RZ
  std::array<double, 64> value_{};  // by code, in [-1, 1]
  std::vector<std::uint8_t> pending_;
};

// Packets of spacenavd, the space mouse daemon: eight int32 in host byte order: kind (0 motion,
// 1 press, 2 release), then x, y, z, rotations about them, and a period; or a button.
class SpaceMouseDecoder final : public GestureDecoder {
 public:
  void feed(const std::uint8_t* bytes, std::size_t count, double now, DesktopInput& input) override;
  void forget() override { pending_.clear(); }

 private:
  std::vector<std::uint8_t> pending_;
};

struct GestureSource {
  std::string description;
  std::unique_ptr<GestureDecoder> decoder;
  OwnedFd fd;                       // non-blocking
  std::function<OwnedFd()> reopen;  // empty: not possible
  std::shared_ptr<void> keep;       // lives as long as the device: a terminal's mode
};

class GestureDevice final : public InputDevice {
 public:
  GestureDevice(GestureSource source, const VirtualOmniSettings& settings);
  ~GestureDevice() override;
  DeviceState poll(double now) noexcept override;
  void render(const DeviceForce& force) noexcept override { omni_.render(force); }
  const OmniParameters& parameters() const override { return omni_.parameters(); }
  std::string description() const override { return source_.description; }
  bool has_motors() const override { return false; }

 private:
  void run();
  bool read_some();

  GestureSource source_;
  std::shared_ptr<DesktopInput> input_;
  VirtualOmni omni_;
  std::atomic<bool> connected_{true};
  OwnedFd stop_;
  std::thread thread_;
};

// Throw InputError: device not available. `path` may be empty.
GestureSource open_keyboard(const std::string& path);     // a terminal, by default /dev/tty
GestureSource open_gamepad(const std::string& path);      // by default the first /dev/input/js*
GestureSource open_space_mouse(const std::string& path);  // spacenavd's socket

}  // namespace twinarm
