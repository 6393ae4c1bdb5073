#include "app/device/devices.h"
#include "app/device/gesture_device.h"

namespace twinarm {

DeviceKind spacemouse_kind() {
  return {.place = 40,
          .name = "spacemouse",
          .argument = "[:SOCKET]",
          .help = "simulated Omni moved by a space mouse (spacenavd)",
          .open = [](const std::string& path, const VirtualOmniSettings& settings) {
            return std::make_unique<GestureDevice>(open_space_mouse(path), settings);
          }};
}

}  // namespace twinarm
