#include "app/device/devices.h"
#include "app/device/gesture_device.h"

namespace twinarm {

DeviceKind gamepad_kind() {
  return {.place = 30,
          .name = "gamepad",
          .argument = "[:/dev/input/jsN]",
          .help = "simulated Omni moved by a game controller",
          .open = [](const std::string& path, const VirtualOmniSettings& settings) {
            return std::make_unique<GestureDevice>(open_gamepad(path), settings);
          }};
}

}  // namespace twinarm
