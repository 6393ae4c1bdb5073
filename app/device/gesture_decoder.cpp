#include "app/device/gesture_device.h"

#include <linux/input-event-codes.h>
#include <linux/joystick.h>

#include <cstring>

namespace twinarm {
namespace {

constexpr double kStickFull = 32767;     // of the kernel's joystick events
constexpr double kSpaceMouseFull = 350;  // spacenavd at full deflection, sensitivity 1
constexpr std::size_t kSpaceMousePacket = 32;

std::size_t axis_index(DeviceAxis axis) {
  return static_cast<std::size_t>(axis);
}

// Last byte of an arrow's escape sequence.
constexpr KeyDecoder::Key kArrows[] = {{'A', DeviceAxis::up, true},
                                       {'B', DeviceAxis::up, false},
                                       {'C', DeviceAxis::right, true},
                                       {'D', DeviceAxis::right, false}};
constexpr KeyDecoder::Key kLetters[] = {
    {'w', DeviceAxis::toward, false}, {'s', DeviceAxis::toward, true},
    {'a', DeviceAxis::yaw, false},    {'d', DeviceAxis::yaw, true},
    {'r', DeviceAxis::pitch, true},   {'f', DeviceAxis::pitch, false},
    {'q', DeviceAxis::roll, true},    {'e', DeviceAxis::roll, false}};

// Calls `take` for each complete packet, in order.
template <std::size_t size, class Take>
void take_packets(std::vector<std::uint8_t>& pending, const std::uint8_t* bytes, std::size_t count,
                  const Take& take) {
  pending.insert(pending.end(), bytes, bytes + count);
  std::size_t at = 0;
  for (; pending.size() - at >= size; at += size) take(pending.data() + at);
  pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(at));
}

}  // namespace

void KeyDecoder::feed(const std::uint8_t* bytes, std::size_t count, double now,
                      DesktopInput& input) {
  for (std::size_t n = 0; n < count; ++n) {
    const std::uint8_t byte = bytes[n];
    if (byte == 0x1b) {
      escape_ = Escape::begun;
    } else if (escape_ == Escape::begun) {
      escape_ = byte == '[' || byte == 'O' ? Escape::sequence : Escape::none;
    } else if (escape_ == Escape::sequence) {
      if (byte < 0x40) continue;  // a parameter (modifier keys)
      escape_ = Escape::none;
      press_key(kArrows, static_cast<char>(byte), now, input);
    } else {
      letter(byte, now, input);
    }
  }
  pass(now, input);
}

void KeyDecoder::letter(std::uint8_t byte, double now, DesktopInput& input) {
  const auto lower = static_cast<char>(byte >= 'A' && byte <= 'Z' ? byte + 0x20 : byte);
  press_key(kLetters, lower, now, input);
  if (lower == ' ') input.button(0, buttons_[0] = !buttons_[0]);
  if (lower == 'c') input.button(1, buttons_[1] = !buttons_[1]);
  if (lower == 'x')
    for (std::size_t axis = 0; axis < 6; ++axis)
      for (std::size_t direction = 0; direction < 2; ++direction) stop(axis, direction, input);
}

void KeyDecoder::press_key(std::span<const Key> keys, char code, double now, DesktopInput& input) {
  for (const Key& key : keys)
    if (key.code == code) press(key.axis, key.positive, now, input);
}

void KeyDecoder::press(DeviceAxis axis, bool positive, double now, DesktopInput& input) {
  const std::size_t direction = positive ? 1 : 0;
  stop(axis_index(axis), 1 - direction, input);
  if (until_[axis_index(axis)][direction] == 0) input.key(axis, positive, true);
  until_[axis_index(axis)][direction] = now + hold_;
}

void KeyDecoder::stop(std::size_t axis, std::size_t direction, DesktopInput& input) {
  if (until_[axis][direction] == 0) return;
  until_[axis][direction] = 0;
  input.key(static_cast<DeviceAxis>(axis), direction == 1, false);
}

void KeyDecoder::pass(double now, DesktopInput& input) {
  for (std::size_t axis = 0; axis < 6; ++axis)
    for (std::size_t direction = 0; direction < 2; ++direction)
      if (now > until_[axis][direction]) stop(axis, direction, input);
}

void KeyDecoder::forget() {
  escape_ = Escape::none;
  until_ = {};
  buttons_ = {};
}

JoystickDecoder::JoystickDecoder(std::vector<std::uint8_t> axis_codes)
    : codes_(std::move(axis_codes)) {
  if (codes_.empty()) codes_ = {ABS_X, ABS_Y, ABS_Z, ABS_RX, ABS_RY, ABS_RZ, ABS_HAT0X, ABS_HAT0Y};
  has_right_stick_ = std::ranges::find(codes_, ABS_RX) != codes_.end();
}

void JoystickDecoder::send_axes(DesktopInput& input) const {
  const auto tilt = [this](int code) { return value_[static_cast<std::size_t>(code)]; };
  const double toward = has_right_stick_ ? tilt(ABS_RY) : tilt(ABS_RZ);
  const double yaw = has_right_stick_ ? tilt(ABS_RX) : tilt(ABS_Z);
  // Triggers rest at -1 each; their difference is used.
  const double triggers = has_right_stick_ ? 0.5 * (tilt(ABS_RZ) - tilt(ABS_Z)) : 0.0;
  const double clockwise = std::clamp(triggers + tilt(ABS_HAT0X), -1.0, 1.0);
  input.axes({tilt(ABS_X), -tilt(ABS_Y), toward, yaw, -tilt(ABS_HAT0Y), -clockwise});
}

void JoystickDecoder::feed(const std::uint8_t* bytes, std::size_t count, double /*now*/,
                           DesktopInput& input) {
  take_packets<sizeof(js_event)>(pending_, bytes, count, [&](const std::uint8_t* packet) {
    js_event event{};
    std::memcpy(&event, packet, sizeof event);
    const int kind = event.type & ~JS_EVENT_INIT;  // initial values too
    if (kind == JS_EVENT_AXIS && event.number < codes_.size() &&
        codes_[event.number] < value_.size()) {
      value_[codes_[event.number]] = std::clamp(event.value / kStickFull, -1.0, 1.0);
      send_axes(input);
    } else if (kind == JS_EVENT_BUTTON && event.number < 2) {
      input.button(event.number, event.value != 0);
    }
  });
}

void JoystickDecoder::forget() {
  pending_.clear();
  value_ = {};
}

void SpaceMouseDecoder::feed(const std::uint8_t* bytes, std::size_t count, double /*now*/,
                             DesktopInput& input) {
  take_packets<kSpaceMousePacket>(pending_, bytes, count, [&](const std::uint8_t* packet) {
    std::array<std::int32_t, 8> word{};
    std::memcpy(word.data(), packet, kSpaceMousePacket);
    if (word[0] == 0) {
      std::array<double, 6> tilt{};
      for (std::size_t n = 0; n < 6; ++n)
        tilt[n] = std::clamp(word[n + 1] / kSpaceMouseFull, -1.0, 1.0);
      // Its z points away from the user; a positive yaw is clockwise about y.
      input.axes({tilt[0], tilt[1], -tilt[2], -tilt[4], tilt[3], -tilt[5]});
    } else if ((word[0] == 1 || word[0] == 2) && word[1] >= 0 && word[1] < 2) {
      input.button(static_cast<std::size_t>(word[1]), word[0] == 1);
    }
  });
}

}  // namespace twinarm
