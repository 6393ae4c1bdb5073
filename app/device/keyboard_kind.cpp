#include "app/device/devices.h"
#include "app/device/gesture_device.h"

namespace twinarm {

DeviceKind keyboard_kind() {
  return {.place = 20,
          .name = "keyboard",
          .argument = "[:TERMINAL]",
          .help = "simulated Omni moved by the keys of a terminal",
          .open = [](const std::string& path, const VirtualOmniSettings& settings) {
            return std::make_unique<GestureDevice>(open_keyboard(path), settings);
          }};
}

}  // namespace twinarm
