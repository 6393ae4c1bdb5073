// From the bytes of an input device to a hand's gestures. Torn and damaged bytes are put together
// or passed over. Device axes: x right, y up, z to the user.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "coupling/device/desktop_input.h"

namespace twinarm {

class GestureDecoder {
 public:
  virtual ~GestureDecoder() = default;
  // `now` [s]: any clock that goes on.
  virtual void feed(const std::uint8_t* bytes, std::size_t count, double now,
                    DesktopInput& hand) = 0;
  virtual void pass(double /*now*/, DesktopInput& /*hand*/) {}  // time goes by without bytes
  virtual void forget() {}  // the device is gone: what it held is let go of
};

// A terminal's keys. Terminals tell presses and their repetition, no release: a key is taken for
// held until `hold` after its last byte.
//   arrows  right, left, up, down       w s  away from the user, to the user
//   a d     yaw                         r f  pitch                q e  roll
//   space   gripper, to and fro         c    clutch, to and fro   x    stand still
class KeyDecoder final : public GestureDecoder {
 public:
  explicit KeyDecoder(double hold = 0.2) : hold_(hold) {}
  void feed(const std::uint8_t* bytes, std::size_t count, double now, DesktopInput& hand) override;
  void pass(double now, DesktopInput& hand) override;
  void forget() override;

 private:
  void letter(std::uint8_t byte, double now, DesktopInput& hand);
  void arrow(std::uint8_t final_byte, double now, DesktopInput& hand);
  void press(HandAxis axis, bool positive, double now, DesktopInput& hand);
  void stop(std::size_t axis, std::size_t direction, DesktopInput& hand);

  double hold_;
  enum class Escape { none, begun, sequence } escape_ = Escape::none;
  std::array<std::array<double, 2>, 6> until_{};  // by axis and direction; 0: not held
  std::array<bool, 2> buttons_{};
};

// Linux joystick events (linux/joystick.h, /dev/input/js*), 8 bytes each. Left stick: right and up.
// Right stick: to the user, yaw. Triggers, or the cross: roll; cross: pitch. First button: gripper,
// second: clutch.
class JoystickDecoder final : public GestureDecoder {
 public:
  // What each axis is, as the kernel says (ABS_X..); empty: as most controllers have it.
  explicit JoystickDecoder(std::vector<std::uint8_t> axis_codes = {});
  void feed(const std::uint8_t* bytes, std::size_t count, double now, DesktopInput& hand) override;
  void forget() override;

 private:
  double tilt(int code) const;
  void tell_axes(DesktopInput& hand) const;

  std::vector<std::uint8_t> codes_;
  bool has_right_stick_;            // RX, RY; else Z and RZ are it
  std::array<double, 64> value_{};  // by code, in [-1, 1]
  std::vector<std::uint8_t> pending_;
};

// The packets of spacenavd, the daemon of space mice: eight int32 in the machine's byte order, kind
// (0 motion, 1 press, 2 release), then x, y, z, turns about them, and a period; or a button.
class SpaceMouseDecoder final : public GestureDecoder {
 public:
  void feed(const std::uint8_t* bytes, std::size_t count, double now, DesktopInput& hand) override;
  void forget() override { pending_.clear(); }

 private:
  std::vector<std::uint8_t> pending_;
};

}  // namespace twinarm
